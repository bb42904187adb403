#include "radiosity/transport/linear_system.h"

#include <tbb/parallel_for.h>

#include <array>

namespace meninas {

namespace {

Rgb weighted(const Transport& transport, std::size_t entry, const Rgb& value) {
  if (transport.bands == 1)
    return double{transport.weights[entry]} * value;
  const float* weight = &transport.weights[3 * entry];
  return Rgb(weight[0], weight[1], weight[2]) * value;
}

double weighted(const Transport& transport, std::size_t entry, double value) {
  return double{transport.weights[entry]} * value;
}

/// In four sums that do not wait for one another's additions.
template <typename Value>
Value row_product(const Transport& transport, std::size_t row, const std::vector<Value>& x) {
  constexpr std::size_t lanes = 4;
  std::array<Value, lanes> sums{};
  const auto term = [&](std::size_t k) { return weighted(transport, k, x[transport.columns[k]]); };
  const std::size_t end = transport.row_begin[row + 1];
  std::size_t k = transport.row_begin[row];
  for (; k + lanes <= end; k += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      sums[lane] += term(k + lane);
  for (; k < end; ++k)
    sums[0] += term(k);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

} // namespace

void append_row(const Transport& from, std::size_t row, Transport& to) {
  const auto begin = static_cast<std::ptrdiff_t>(from.row_begin[row]),
             end = static_cast<std::ptrdiff_t>(from.row_begin[row + 1]);
  to.columns.insert(to.columns.end(), from.columns.begin() + begin, from.columns.begin() + end);
  to.weights.insert(to.weights.end(), from.weights.begin() + begin * from.bands,
                    from.weights.begin() + end * from.bands);
  to.row_begin.push_back(to.columns.size());
}

template <typename Value>
std::vector<Value> transport_product(const Transport& transport, const std::vector<Value>& x) {
  std::vector<Value> product(transport.size);
  tbb::parallel_for(std::size_t{0}, product.size(),
                    [&](std::size_t i) { product[i] = row_product(transport, i, x); });
  return product;
}

LightByLamp transport_product(const Transport& transport, const LightByLamp& x) {
  LightByLamp product{.rows = transport.size, .columns = x.columns};
  tbb::parallel_for(std::size_t{0}, transport.size, [&](std::size_t i) {
    const std::span<double> row = product[i];
    for (std::uint64_t k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k) {
      const std::span<const double> sent = x[transport.columns[k]];
      const float* const weights = &transport.weights[k * static_cast<std::size_t>(transport.bands)];
      for (std::size_t c = 0; c < row.size(); ++c)
        row[c] += double{weights[transport.bands == 1 ? 0 : c % 3]} * sent[c];
    }
  });
  return product;
}

template <typename Value>
std::vector<Value> reflected(const LinearSystem<Value>& system, const std::vector<Value>& x) {
  std::vector<Value> light = transport_product(system.transport, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    light[i] *= system.reflectance[i];
  return light;
}

template <typename Value>
std::vector<Value> residual_of(const LinearSystem<Value>& system, const std::vector<Value>& x) {
  std::vector<Value> residual = reflected(system, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    residual[i] = (system.source[i] - x[i]) + residual[i];
  return residual;
}

template <typename Value>
Value relax_rows(const LinearSystem<Value>& system, std::size_t begin, std::size_t end,
                 std::vector<Value>& x, std::vector<Value>& scratch) {
  tbb::parallel_for(begin, end, [&](std::size_t i) {
    scratch[i] = system.source[i] + system.reflectance[i] * row_product(system.transport, i, x);
  });
  Value change(0.0);
  for (std::size_t i = begin; i < end; ++i) {
    change = glm::max(change, glm::abs(scratch[i] - x[i]));
    x[i] = scratch[i];
  }
  return change;
}

template <typename Value>
Value maximum_norm(const std::vector<Value>& x) {
  Value norm(0.0);
  for (const auto& value : x)
    norm = glm::max(norm, glm::abs(value));
  return norm;
}

template <typename Value>
Value inner_product(const std::vector<Value>& a, const std::vector<Value>& b) {
  Value sum(0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

template std::vector<Rgb> transport_product(const Transport&, const std::vector<Rgb>&);
template std::vector<double> transport_product(const Transport&, const std::vector<double>&);
template std::vector<Rgb> reflected(const LinearSystem<Rgb>&, const std::vector<Rgb>&);
template std::vector<double> reflected(const LinearSystem<double>&, const std::vector<double>&);
template std::vector<Rgb> residual_of(const LinearSystem<Rgb>&, const std::vector<Rgb>&);
template std::vector<double> residual_of(const LinearSystem<double>&, const std::vector<double>&);
template Rgb relax_rows(const LinearSystem<Rgb>&, std::size_t, std::size_t, std::vector<Rgb>&,
                        std::vector<Rgb>&);
template double relax_rows(const LinearSystem<double>&, std::size_t, std::size_t,
                           std::vector<double>&, std::vector<double>&);
template Rgb maximum_norm(const std::vector<Rgb>&);
template double maximum_norm(const std::vector<double>&);
template Rgb inner_product(const std::vector<Rgb>&, const std::vector<Rgb>&);
template double inner_product(const std::vector<double>&, const std::vector<double>&);

} // namespace meninas
