#include "radiosity/solvers/error_bound.h"

#include "radiosity/solvers/solvers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meninas {

namespace {

/// A row that returns all but this of what it gathers absorbs nothing as far as can be told:
/// weights are floats.
constexpr double closed_rounding = 1.2e-7;

/// By row and channel: 1 where light can still leave or be absorbed.
template <typename Value>
struct Escapes {
  std::vector<Value> open;
  bool all = true;
};

template <typename Value>
Escapes<Value> rows_that_lose_light(const LinearSystem<Value>& system) {
  const std::size_t size = system.transport.size;
  const std::vector<Value> kept = reflected(system, std::vector<Value>(size, Value(1.0)));
  Escapes<Value> escapes{std::vector<Value>(size, Value(0.0)), true};
  for (std::size_t i = 0; i < size; ++i)
    for (int band = 0; band < channel_count<Value>; ++band) {
      const bool loses = channel(kept[i], band) < 1.0 - closed_rounding;
      channel(escapes.open[i], band) = loses ? 1.0 : 0.0;
      escapes.all = escapes.all && loses;
    }
  return escapes;
}

template <typename Value>
Value minimum(const std::vector<Value>& x) {
  Value least(0.0);
  for (const Value& value : x)
    least = glm::min(least, value);
  return least;
}

} // namespace

template <typename Value>
std::vector<Value> open_rows(const LinearSystem<Value>& system) {
  const Transport& transport = system.transport;
  Escapes<Value> escapes = rows_that_lose_light(system);

  // A row is open when it loses light or gathers from an open one:
  // light that goes round long enough gets there.
  bool changed = !escapes.all;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < transport.size; ++i) {
      Value open = escapes.open[i];
      for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k)
        open = glm::max(open, escapes.open[transport.columns[k]]);
      changed = changed || open != escapes.open[i];
      escapes.open[i] = open;
    }
  }
  return std::move(escapes.open);
}

template <typename Value>
LinearSystem<Value> without_traps(LinearSystem<Value> system, const std::vector<Value>& open) {
  for (std::size_t i = 0; i < open.size(); ++i)
    system.reflectance[i] *= open[i];
  return system;
}

template <typename Value>
Value contraction(const LinearSystem<Value>& system) {
  return maximum_norm(reflected(system, std::vector<Value>(system.transport.size, Value(1.0))));
}

template <typename Value>
std::vector<Value> lit_rows(const LinearSystem<Value>& system) {
  const Transport& transport = system.transport;
  std::vector<Value> lit(transport.size, Value(0.0));
  for (std::size_t i = 0; i < transport.size; ++i)
    for (int band = 0; band < channel_count<Value>; ++band)
      channel(lit[i], band) = channel(system.source[i], band) > 0.0 ? 1.0 : 0.0;
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < transport.size; ++i) {
      Value arrives = lit[i];
      for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1] && arrives != Value(1.0);
           ++k)
        arrives = glm::max(arrives, lit[transport.columns[k]]);
      changed = changed || arrives != lit[i];
      lit[i] = arrives;
    }
  }
  return lit;
}

template <typename Value>
Value amplification_bound(const LinearSystem<Value>& system, int max_iterations) {
  constexpr double sharp = 0.1;   // of ||q||: leaves the bound within a factor (1 + q) / (1 - q)
  constexpr int max_bounces = 4; // of the Neumann series, which suffices for dark rooms
  // A bound is worth some seconds, and not more than the solution.
  constexpr double affordable_entries = 2e9, low = 40.0, high = 200.0;
  const double entries = 1.0 + double(system.transport.columns.size());
  const auto enough_iterations = std::min(
      max_iterations, static_cast<int>(std::clamp(affordable_entries / entries, low,
                                                  high)));
  const LinearSystem<Value> ones{system.transport, lit_rows(system), system.reflectance};

  // The sum of m bounces of ones leaves q = (rho T)^m 1.
  std::vector<Value> g = ones.source, q = reflected(system, g);
  for (int m = 1; m < max_bounces && worst(maximum_norm(q)) > sharp; ++m) {
    for (std::size_t i = 0; i < g.size(); ++i)
      g[i] += q[i];
    q = reflected(system, q);
  }
  int iterations = 0;
  bicgstab_run<Value>(ones, g, [&](const Value& residual, const Value&) {
    const bool enough = worst(residual) <= sharp || iterations++ >= enough_iterations;
    return Value(enough ? 0.0 : 1.0);
  });

  const Value left = maximum_norm(residual_of(ones, g)), size = maximum_norm(g), least = minimum(g);
  Value bound(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    channel(bound, band) = channel(left, band) < 1.0 && channel(least, band) >= 0.0
                               ? channel(size, band) / (1.0 - channel(left, band))
                               : std::numeric_limits<double>::infinity();
  return bound;
}

template <typename Value>
Value relative_error(const LinearSystem<Value>& system, const std::vector<Value>& x,
                     std::span<const double> areas) {
  constexpr int bounces = 4;
  double area = 0.0;
  for (const double a : areas)
    area += a;
  const auto mean_share = [&](const std::vector<Value>& part) {
    Value sum(0.0);
    for (std::size_t i = 0; i < areas.size(); ++i)
      sum += areas[i] * glm::min(share_of(part[i], x[i]), Value(1.0));
    return area > 0.0 ? sum / area : Value(0.0);
  };
  std::vector<Value> left = residual_of(system, x);
  for (Value& value : left)
    value = glm::abs(value);
  std::vector<Value> sum = left;
  Value now = mean_share(left), before = now;
  for (int m = 0; m < bounces; ++m) {
    left = reflected(system, left);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += left[i];
    before = now;
    now = mean_share(left);
  }
  // The bounces after these: where they do not decline, there are a hundred.
  constexpr double slowest = 0.99;
  Value rest(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    if (channel(now, band) > 0.0) {
      const double ratio = std::min(channel(now, band) / channel(before, band), slowest);
      channel(rest, band) = ratio / (1.0 - ratio);
    }
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] += rest * left[i];
  return mean_share(sum);
}

template std::vector<Rgb> open_rows(const LinearSystem<Rgb>&);
template std::vector<double> open_rows(const LinearSystem<double>&);
template LinearSystem<Rgb> without_traps(LinearSystem<Rgb>, const std::vector<Rgb>&);
template LinearSystem<double> without_traps(LinearSystem<double>, const std::vector<double>&);
template Rgb relative_error(const LinearSystem<Rgb>&, const std::vector<Rgb>&,
                            std::span<const double>);
template double relative_error(const LinearSystem<double>&, const std::vector<double>&,
                               std::span<const double>);
template Rgb contraction(const LinearSystem<Rgb>&);
template double contraction(const LinearSystem<double>&);
template std::vector<Rgb> lit_rows(const LinearSystem<Rgb>&);
template std::vector<double> lit_rows(const LinearSystem<double>&);
template Rgb amplification_bound(const LinearSystem<Rgb>&, int);
template double amplification_bound(const LinearSystem<double>&, int);

} // namespace meninas
