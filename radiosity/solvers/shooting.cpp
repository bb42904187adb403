#include "radiosity/solvers/shooting.h"

#include "radiosity/solvers/report.h"

#include <numeric>

namespace meninas {

Shooters single_shooters(std::size_t unknowns) {
  Shooters shooters;
  shooters.of_unknown.resize(unknowns);
  std::iota(shooters.of_unknown.begin(), shooters.of_unknown.end(), 0U);
  shooters.unknowns = shooters.begin = shooters.of_unknown;
  shooters.begin.push_back(static_cast<std::uint32_t>(unknowns));
  shooters.measure.assign(unknowns, 1.0);
  return shooters;
}

template <typename Value>
ShotState<Value> unshot_state(const Shooters& shooters, const std::vector<Value>& source,
                              const std::vector<Value>& reflectance, ShotNorm norm) {
  const std::vector<Value> nothing(source.size(), Value(0.0));
  ShotState<Value> state{shooters, source, reflectance, norm, nothing, source, {}};
  state.left.assign(shooters.size(), Value(0.0));
  for (std::uint32_t i = 0; i < source.size(); ++i)
    state.count(i, source[i]);
  return state;
}

template <typename Value>
std::vector<Value> radiosities(const ShotState<Value>& state) {
  std::vector<Value> values;
  values.reserve(state.source.size());
  for (std::size_t i = 0; i < state.source.size(); ++i)
    values.push_back(state.radiosity(i));
  return values;
}

namespace {

/// The values with the largest channel, each in units of `size`; the first of equals.
template <typename Value>
std::size_t place_of_max(const std::vector<Value>& values, const Value& size) {
  Value per_size(0.0); // of a channel without any light there is no most
  for (int band = 0; band < channel_count<Value>; ++band)
    if (channel(size, band) > 0.0)
      channel(per_size, band) = 1.0 / channel(size, band);
  std::size_t place = 0;
  double most = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const double relative = worst(values[k] * per_size); relative > most) {
      most = relative;
      place = k;
    }
  return place;
}

} // namespace

template <typename Value>
LeftToShoot<Value> left_to_shoot(const ShotState<Value>& state, double little) {
  const Value power = std::accumulate(state.left.begin(), state.left.end(), Value(0.0));
  if (state.norm == ShotNorm::power)
    return {place_of_max(state.left, state.power), power};
  const Value brightest = maximum_norm(state.unshot);
  if (worst(share_of(power, state.power)) > little)
    return {place_of_max(state.left, state.power), brightest};
  if (state.unshot.empty()) // a scene of mirrors alone
    return {0, brightest};
  return {state.shooters.of_unknown[place_of_max(state.unshot, state.largest)], brightest};
}

template <typename Value>
AfterShot<Value> observer_of(const ShotWatch& watch) {
  return [watch](const ShotState<Value>& state, const Convergence<Value>& reached) {
    const bool due = watch.every > 0 && state.shots > 0 && state.shots % watch.every == 0;
    if (due || (watch.every > 0 && finished(reached)))
      watch.look({state.shots, colours_of(state.arrived), colours_of(state.unshot)});
  };
}

template <typename Value>
void ShotHistory<Value>::add(Convergence<Value>& convergence, const Value& residual_norm,
                             const Value& size) {
  constexpr std::size_t longest = 2048;
  if (since_kept_ > 0)
    record_again(convergence, residual_norm, size);
  else
    record(convergence, residual_norm, size);
  since_kept_ = (since_kept_ + 1) % stride_;
  if (convergence.residuals.size() < longest)
    return;

  // The last record stays: it is that of the present.
  const auto thin = [](std::vector<Value>& records) {
    const Value last = records.back();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < records.size(); k += 2)
      records[kept++] = records[k];
    records.resize(kept);
    records.back() = last;
  };
  thin(convergence.residuals);
  thin(convergence.error_bounds);
  stride_ *= 2;
  since_kept_ = 1;
}

template ShotState<Rgb> unshot_state(const Shooters&, const std::vector<Rgb>&,
                                     const std::vector<Rgb>&, ShotNorm);
template ShotState<double> unshot_state(const Shooters&, const std::vector<double>&,
                                        const std::vector<double>&, ShotNorm);
template std::vector<Rgb> radiosities(const ShotState<Rgb>&);
template std::vector<double> radiosities(const ShotState<double>&);
template LeftToShoot<Rgb> left_to_shoot(const ShotState<Rgb>&, double);
template LeftToShoot<double> left_to_shoot(const ShotState<double>&, double);
template AfterShot<Rgb> observer_of(const ShotWatch&);
template AfterShot<double> observer_of(const ShotWatch&);
template class ShotHistory<Rgb>;
template class ShotHistory<double>;

} // namespace meninas
