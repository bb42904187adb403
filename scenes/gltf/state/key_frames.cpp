#include "scenes/gltf/state/key_frames.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

namespace {

/// Where a time is among the keys: u of the way from a key to the next, or at one.
struct Moment {
  std::size_t key = 0, next = 0;
  double length = 0.0; ///< seconds between them
  double u = 0.0;
};

} // namespace

static Moment moment_at(std::span<const double> times, double seconds) {
  const auto after =
      static_cast<std::size_t>(std::ranges::upper_bound(times, seconds) - times.begin());
  if (after == 0 || after == times.size())
    return {after == 0 ? 0 : after - 1, after == 0 ? 0 : after - 1};
  const double length = times[after] - times[after - 1];
  return {after - 1, after, length, (seconds - times[after - 1]) / length};
}

std::size_t elements_per_key(KeyInterpolation interpolation) {
  return interpolation == KeyInterpolation::cubic_spline ? 3 : 1;
}

/// Of a key: its value, or of a spline the tangent into it, -1, and out of it, +1.
static std::span<const double> element_of(const KeyFrames& keys, std::size_t key, int tangent = 0) {
  const bool spline = keys.interpolation == KeyInterpolation::cubic_spline;
  const std::size_t element = spline ? 3 * key + 1 : key;
  return keys.values.subspan((element + static_cast<std::size_t>(tangent)) * keys.width,
                             keys.width);
}

static std::vector<double> on_spline(const KeyFrames& keys, const Moment& m) {
  const double u = m.u, u2 = u * u, u3 = u2 * u;
  const auto v0 = element_of(keys, m.key), b = element_of(keys, m.key, 1);
  const auto a = element_of(keys, m.next, -1), v1 = element_of(keys, m.next);
  std::vector<double> value(keys.width);
  for (std::size_t c = 0; c < keys.width; ++c)
    value[c] = (2.0 * u3 - 3.0 * u2 + 1.0) * v0[c] + m.length * (u3 - 2.0 * u2 + u) * b[c] +
               (3.0 * u2 - 2.0 * u3) * v1[c] + m.length * (u3 - u2) * a[c];
  return value;
}

std::vector<double> value_at(const KeyFrames& keys, double seconds) {
  const Moment m = moment_at(keys.times, seconds);
  const auto here = element_of(keys, m.key);
  if (m.key == m.next || keys.interpolation == KeyInterpolation::step)
    return {here.begin(), here.end()};
  if (keys.interpolation == KeyInterpolation::cubic_spline)
    return on_spline(keys, m);
  const auto there = element_of(keys, m.next);
  std::vector<double> value(keys.width);
  for (std::size_t c = 0; c < keys.width; ++c)
    value[c] = (1.0 - m.u) * here[c] + m.u * there[c];
  return value;
}

/// Of length one, without overflow or underflow on the way.
static glm::dvec4 unit(std::span<const double> q) {
  double largest = 0.0;
  for (const double x : q)
    largest = std::max(largest, std::abs(x));
  if (largest == 0.0)
    return glm::dvec4(0.0);
  return glm::normalize(glm::dvec4(q[0], q[1], q[2], q[3]) / largest);
}

static glm::dvec4 between(const glm::dvec4& from, const glm::dvec4& to, double u) {
  const glm::dvec4 near = glm::dot(from, to) < 0.0 ? -to : to;
  // The arc cosine of what is nearly 1 has half of the digits.
  const double angle = 2.0 * std::atan2(glm::length(from - near), glm::length(from + near));
  const double sine = std::sin(angle);
  if (!(sine > 0.0))
    return from;
  return std::sin((1.0 - u) * angle) / sine * from + std::sin(u * angle) / sine * near;
}

std::array<double, 4> rotation_at(const KeyFrames& keys, double seconds) {
  const Moment m = moment_at(keys.times, seconds);
  const bool turns = m.key != m.next && keys.interpolation == KeyInterpolation::linear;
  const glm::dvec4 q = turns ? between(unit(element_of(keys, m.key)),
                                       unit(element_of(keys, m.next)), m.u)
                             : unit(value_at(keys, seconds));
  return {q.x, q.y, q.z, q.w};
}

} // namespace meninas::gltf
