#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/shooting.h"
#include "radiosity/solvers/solvers.h"

#include <utility>

namespace meninas {

namespace {

/// T by columns.
struct NodeColumns {
  std::vector<std::uint64_t> begin; ///< unknowns + 1
  std::vector<std::uint32_t> rows;
  std::vector<float> weights;
};

NodeColumns columns_of(const Transport& transport) {
  const auto bands = static_cast<std::size_t>(transport.bands);
  NodeColumns columns;
  columns.begin.assign(transport.size + 1, 0);
  for (const auto column : transport.columns)
    ++columns.begin[column + 1];
  for (std::size_t j = 0; j < transport.size; ++j)
    columns.begin[j + 1] += columns.begin[j];
  columns.rows.resize(transport.columns.size());
  columns.weights.resize(transport.weights.size());
  auto place = columns.begin;
  for (std::size_t i = 0; i < transport.size; ++i)
    for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k) {
      const std::uint64_t at = place[transport.columns[k]]++;
      columns.rows[at] = static_cast<std::uint32_t>(i);
      for (std::size_t band = 0; band < bands; ++band)
        columns.weights[at * bands + band] = transport.weights[k * bands + band];
    }
  return columns;
}

template <typename Value>
class StoredColumns {
public:
  explicit StoredColumns(const Transport& transport)
      : columns_(columns_of(transport)), bands_(transport.bands) {}

  void shoot(std::size_t shooter, ShotState<Value>& state) {
    const auto members = state.shooters.members(shooter);
    std::vector<Value> shot;
    for (const auto member : members)
      shot.push_back(std::exchange(state.unshot[member], Value(0.0)));
    state.left[shooter] = Value(0.0);
    for (std::size_t m = 0; m < members.size(); ++m)
      for (auto k = columns_.begin[members[m]]; k < columns_.begin[members[m] + 1]; ++k)
        state.arrive(columns_.rows[k], weighted(k, shot[m]));
  }

private:
  Value weighted(std::uint64_t entry, const Value& value) const {
    if constexpr (channel_count<Value> == 3) {
      if (bands_ == 3) {
        const float* weight = &columns_.weights[3 * entry];
        return Rgb(weight[0], weight[1], weight[2]) * value;
      }
    }
    return double{columns_.weights[entry]} * value;
  }

  NodeColumns columns_;
  int bands_;
};

} // namespace

template <typename Value>
void shoot_stored(const LinearSystem<Value>& system, const ShotPlan& plan, std::vector<Value>& x,
                  Convergence<Value>& convergence) {
  const Shooters shooters = plan.shooters.begin.empty() ? single_shooters(x.size()) : plan.shooters;
  ShotState<Value> state =
      unshot_state(shooters, system.source, system.reflectance, ShotNorm::maximum);
  StoredColumns<Value> columns(system.transport);
  shoot(columns, contraction(system), state, convergence, observer_of<Value>(plan.watch));
  x = radiosities(state);
  record_again(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
}

template void shoot_stored(const LinearSystem<Rgb>&, const ShotPlan&, std::vector<Rgb>&,
                           Convergence<Rgb>&);
template void shoot_stored(const LinearSystem<double>&, const ShotPlan&, std::vector<double>&,
                           Convergence<double>&);

} // namespace meninas
