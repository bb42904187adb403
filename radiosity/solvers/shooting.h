// Progressive radiosity (Cohen, Chen, Wallace, Greenberg 1988):
// what has most to shoot shoots first, Southwell's order.
//
// Every unknown j keeps the radiosity U_j that it has not shot yet, S_j to begin with. A shot
// of U_j brings the irradiance T_ij U_j to every i, that is a column of T, and makes U_j zero:
//   B_i += rho_i T_ij U_j,   U_i += rho_i T_ij U_j,
// and with tau for rho where i is behind what receives it (transport/translucency.h).
// So B = S + rho T (B - U) at any time: the residual is rho T U, and no row of T is ever needed.
// Unknowns may shoot together, as a shooter.
// The solver knows no geometry: a source of columns carries out the shot.
//
// The shooter of the largest power, the sum of m |U| with the measures m (areas) of its members,
// is next. Convergence is in one of two norms:
//   power    the sum of all m |U|, in which rho T is bounded by its columns: m_j T_ij shares out what j shoots
//   maximum  the largest |U|, in which rho T is bounded by its rows. When hardly any power is left, small and bright unknowns may still
//            have some: then the brightest is next.
#pragma once

#include "radiosity/solvers/report.h"
#include "radiosity/solvers/shooters.h"
#include "radiosity/transport/translucency.h"

#include <concepts>
#include <functional>

namespace meninas {

enum class ShotNorm { maximum, power };

/// tau by rows, and by columns (transport/translucency.h).
struct PassedShots {
  TranslucentLinks from, to;
};

template <typename Value>
struct ShotState {
  const Shooters& shooters;
  const std::vector<Value>& source;      ///< S
  const std::vector<Value>& reflectance; ///< rho
  ShotNorm norm;
  std::vector<Value> arrived; ///< the irradiance of all shots: B = S + rho times that
  std::vector<Value> unshot;  ///< U
  std::vector<Value> left;    ///< by shooter: the sum of m U of its members
  Value power{0.0};           ///< the sum of m B
  Value largest{0.0};         ///< the largest B, kept in the maximum norm
  int shots = 0;
  const PassedShots* translucent = nullptr; ///< where there are some

  /// ||B||
  const Value& size() const { return norm == ShotNorm::power ? power : largest; }

  Value radiosity(std::size_t unknown) const {
    Value light = source[unknown] + reflectance[unknown] * arrived[unknown];
    if (translucent)
      for (auto k = translucent->from.row_begin[unknown];
           k < translucent->from.row_begin[unknown + 1]; ++k)
        light += value_of<Value>(translucent->from.transmittance[k]) *
                 arrived[translucent->from.columns[k]];
    return light;
  }
  /// Irradiance has arrived at an unknown.
  void arrive(std::uint32_t unknown, const Value& irradiance) {
    arrived[unknown] += irradiance;
    scatter(unknown, reflectance[unknown] * irradiance);
    if (translucent)
      for (auto k = translucent->to.row_begin[unknown]; k < translucent->to.row_begin[unknown + 1];
           ++k)
        scatter(translucent->to.columns[k],
                value_of<Value>(translucent->to.transmittance[k]) * irradiance);
  }
  /// It is left to shoot.
  void scatter(std::uint32_t unknown, const Value& light) {
    unshot[unknown] += light;
    count(unknown, light);
  }
  /// An unknown has so much more.
  void count(std::uint32_t unknown, const Value& more) {
    const Value own = shooters.measure[unknown] * more;
    left[shooters.of_unknown[unknown]] += own;
    power += own;
    if (norm == ShotNorm::maximum)
      largest = glm::max(largest, radiosity(unknown));
  }
};

template <typename Value>
std::vector<Value> radiosities(const ShotState<Value>& state);

/// Nothing is shot yet. The state refers to all of these.
template <typename Value>
ShotState<Value> unshot_state(const Shooters& shooters, const std::vector<Value>& source,
                              const std::vector<Value>& reflectance, ShotNorm norm);

/// Shoots all that the members of a shooter have:
/// makes their U zero (and what the shooter has left), then tells the state what arrives where.
template <typename Source, typename Value>
concept ColumnSource = requires(Source& source, ShotState<Value>& state, std::size_t shooter) {
  { source.shoot(shooter, state) } -> std::same_as<void>;
};

/// The unshot light: the next shooter, and ||U||.
template <typename Value>
struct LeftToShoot {
  std::size_t shooter = 0;
  Value norm{0.0};
};
/// `little`: the share of the power in all there is that is hardly any.
template <typename Value>
LeftToShoot<Value> left_to_shoot(const ShotState<Value>& state, double little);

/// Adds the present state to the history.
/// A long history keeps every second, fourth, ... record, and the last.
template <typename Value>
class ShotHistory {
public:
  void add(Convergence<Value>& convergence, const Value& residual_norm, const Value& size);

private:
  int stride_ = 1, since_kept_ = 0;
};

/// Told of the state before the first shot and after each.
template <typename Value>
using AfterShot = std::function<void(const ShotState<Value>&, const Convergence<Value>&)>;

/// The callback after each shot that informs a watch.
template <typename Value>
AfterShot<Value> observer_of(const ShotWatch& watch);

/// Shoots until the convergence has finished;
/// its iterations are shots. `kept` is ||rho T||, by channel.
template <typename Value, ColumnSource<Value> Source>
void shoot(Source& source, const Value& kept, ShotState<Value>& state,
           Convergence<Value>& convergence, const AfterShot<Value>& after) {
  ShotHistory<Value> history;
  for (;;) {
    const auto left = left_to_shoot(state, convergence.tolerance);
    history.add(convergence, kept * left.norm, state.size());
    after(state, convergence);
    if (finished(convergence))
      return;
    source.shoot(left.shooter, state);
    convergence.iterations = ++state.shots;
  }
}

} // namespace meninas
