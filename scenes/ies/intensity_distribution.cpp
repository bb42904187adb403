#include "scenes/ies/intensity_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meninas {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

/// Between two measured angles.
struct Between {
  std::size_t low = 0, high = 0;
  double share = 0.0; ///< of the higher
};

/// Nothing beyond the first and last angle. Angles that rounding puts there are still theirs.
std::optional<Between> between(const std::vector<double>& angles, double angle) {
  constexpr double rounding = 1e-6;
  if (angle < angles.front() - rounding || angle > angles.back() + rounding)
    return std::nullopt;
  const auto above = std::ranges::upper_bound(angles, angle);
  const auto high = std::min(static_cast<std::size_t>(above - angles.begin()), angles.size() - 1);
  if (high == 0 || angles.size() == 1)
    return Between{high, high, 0.0};
  const double from = angles[high - 1], to = angles[high];
  return Between{high - 1, high, std::clamp((angle - from) / (to - from), 0.0, 1.0)};
}

/// The angle that stands for f by the symmetry of what was measured.
double folded(const std::vector<double>& angles, double f) {
  if (angles.size() == 1)
    return angles.front();
  if (angles.front() == 90.0 && angles.back() == 270.0)
    return f < 90.0 ? 180.0 - f : f > 270.0 ? 540.0 - f : f;
  if (angles.back() > 180.0)
    return f;
  if (f > 180.0)
    f = 360.0 - f;
  return angles.back() > 90.0 ? f : std::min(f, 180.0 - f);
}

} // namespace

double intensity_at(const IntensityDistribution& distribution, const Direction& d) {
  const bool type_c = distribution.photometry == Photometry::type_c;
  double vertical = 0.0, horizontal = 0.0;
  if (type_c) {
    // By its tangent, for the cosine is flat where luminaires aim.
    vertical = degrees * std::atan2(std::hypot(d.x, d.y), -d.z);
    const double f = degrees * std::atan2(d.y, d.x);
    horizontal = folded(distribution.horizontal, f < 0.0 ? f + 360.0 : f);
  } else {
    vertical = degrees * std::asin(std::clamp(d.x, -1.0, 1.0));
    const double h = degrees * std::atan2(-d.y, -d.z);
    const bool halves = distribution.horizontal.front() >= 0.0;
    horizontal = distribution.horizontal.size() == 1 ? distribution.horizontal.front()
                                                     : (halves ? std::abs(h) : h);
  }
  const auto v = between(distribution.vertical, vertical);
  const auto h = between(distribution.horizontal, horizontal);
  if (!v || !h)
    return 0.0;
  const auto value = [&](std::size_t plane) {
    const double* row = distribution.candela.data() + plane * distribution.vertical.size();
    return (1.0 - v->share) * row[v->low] + v->share * row[v->high];
  };
  return (1.0 - h->share) * value(h->low) + h->share * value(h->high);
}

double luminous_flux(const IntensityDistribution& distribution) {
  constexpr int across = 180, around = 360;
  double flux = 0.0;
  for (int i = 0; i < across; ++i) {
    const double upper = std::cos(std::numbers::pi * i / across);
    const double lower = std::cos(std::numbers::pi * (i + 1) / across);
    const double g = std::numbers::pi * (i + 0.5) / across;
    double ring = 0.0;
    for (int k = 0; k < around; ++k) {
      const double f = 2.0 * std::numbers::pi * (k + 0.5) / around;
      ring += intensity_at(distribution, {std::sin(g) * std::cos(f), std::sin(g) * std::sin(f), -std::cos(g)});
    }
    flux += ring * 2.0 * std::numbers::pi / around * (upper - lower);
  }
  return flux;
}

} // namespace meninas
