#include "scenes/surfaces/precision.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {

namespace {

/// Beyond this multiple of the median distance the floats of a frame around all of it
/// would leave the detail too few digits: of 24 bits eleven go to the rest.
/// Below, one frame and one tolerance serve all: a small thing of most triangles in a room is not
/// what its walls are far away from.
constexpr double far_away = 2048.0;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The corners of all triangles: vertices that none has are nowhere.
std::vector<VertexId> corners_of(const Scene& scene) {
  std::vector<VertexId> all;
  all.reserve(3 * scene.triangles.size());
  for (const Triangle& triangle : scene.triangles)
    all.insert(all.end(), triangle.vertices.begin(), triangle.vertices.end());
  return all;
}

/// Whether the median distance from any point is certainly more than the diagonal of all corners
/// over `far_away`: where no slab so wide, across the longest side of their box, has half of them.
bool is_spread_out(const Scene& scene, const std::vector<VertexId>& corners) {
  Bounds bounds;
  for (const VertexId v : corners) {
    bounds.low = glm::min(bounds.low, position(scene, v));
    bounds.high = glm::max(bounds.high, position(scene, v));
  }
  const Vec3 extent = bounds.high - bounds.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  // The diagonal is at most sqrt(3) sides, and 2 sqrt(3) / far_away of a side less than two parts:
  // a slab touches three.
  constexpr std::size_t parts = 1024;
  std::array<std::size_t, parts + 2> count{};
  const double per_length = parts / extent[axis];
  if (!std::isfinite(per_length))
    return false;
  for (const VertexId v : corners) {
    const double at = (position(scene, v)[axis] - bounds.low[axis]) * per_length;
    ++count[at < parts ? static_cast<std::size_t>(at) : parts - 1];
  }
  for (std::size_t k = 0; k < parts; ++k)
    if (2 * (count[k] + count[k + 1] + count[k + 2]) >= corners.size())
      return false;
  return true;
}

Point3 median_of(const Scene& scene, const std::vector<VertexId>& corners) {
  Point3 centre(0.0);
  std::vector<double> values(corners.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(corners, values.begin(),
                           [&](VertexId v) { return position(scene, v)[axis]; });
    centre[axis] = median(values);
  }
  return centre;
}

/// Bound on the rounding error of one position.
double error_at(const Scene& scene, VertexId vertex) {
  return index(vertex) < scene.position_errors.size()
             ? std::min(scene.position_error, double{scene.position_errors[index(vertex)]})
             : scene.position_error;
}

/// Each vertex is off by at most the position error. A plane through three corners of a
/// parallelogram misses the fourth, p0 - p1 + p2, by at most four times that: three errors and its
/// own.
/// Modelling programs round to about nine digits; sums of products of coordinates lose a few units
/// in the last place.
double tolerance_for(double error, double extent, double largest) {
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  return 4.0 * error + 1e-9 * extent + rounding * largest;
}

} // namespace

Detail detail_of(const Scene& scene) {
  if (scene.triangles.empty())
    return {};
  const std::vector<VertexId> corners = corners_of(scene);
  const auto all = [&]() -> Detail {
    const Bounds bounds = bounds_of(scene);
    return {0.5 * bounds.low + 0.5 * bounds.high, 0.5 * glm::distance(bounds.low, bounds.high)};
  };
  if (is_spread_out(scene, corners))
    return all();
  const Point3 centre = median_of(scene, corners);
  std::vector<double> distances(corners.size());
  std::ranges::transform(corners, distances.begin(),
                         [&](VertexId v) { return glm::distance(position(scene, v), centre); });
  const double farthest = std::ranges::max(distances);
  const double within = far_away * median(distances);
  if (!(within > 0.0) || farthest <= within)
    return all();
  Detail detail{centre, 0.0, false};
  for (const double distance : distances)
    if (distance <= within)
      detail.radius = std::max(detail.radius, distance);
  return detail;
}

Precision::Precision(const Scene& scene) : scene_(scene), detail_(detail_of(scene)) {
  if (detail_.is_all) {
    const Bounds bounds = bounds_of(scene);
    error_ = scene.position_error;
    in_detail_ = tolerance_for(error_, glm::distance(bounds.low, bounds.high),
                               std::max(glm::length(bounds.low), glm::length(bounds.high)));
    return;
  }
  double largest = 0.0;
  for (const VertexId vertex : corners_of(scene)) {
    const Point3& x = position(scene, vertex);
    if (glm::distance(x, detail_.centre) > detail_.radius)
      continue;
    error_ = std::max(error_, error_at(scene, vertex));
    largest = std::max(largest, glm::length(x));
  }
  in_detail_ = tolerance_for(error_, 2.0 * detail_.radius, largest);
}

double Precision::at(VertexId vertex) const {
  if (detail_.is_all)
    return in_detail_;
  const Point3& x = position(scene_, vertex);
  const double distance = glm::distance(x, detail_.centre);
  if (distance <= detail_.radius)
    return in_detail_;
  const double error = std::max(error_, error_at(scene_, vertex));
  return std::max(in_detail_, tolerance_for(error, 2.0 * distance, glm::length(x)));
}

double Precision::of(TriangleId triangle) const {
  const auto& [a, b, c] = scene_.triangles[index(triangle)].vertices;
  return detail_.is_all ? in_detail_ : std::max({at(a), at(b), at(c)});
}

double Precision::alone(TriangleId triangle) const {
  double error = 0.0, extent = 0.0, largest = 0.0;
  const auto& vertices = scene_.triangles[index(triangle)].vertices;
  for (const VertexId vertex : vertices) {
    const Point3& x = position(scene_, vertex);
    error = std::max(error, error_at(scene_, vertex));
    extent = std::max(extent, glm::distance(x, position(scene_, vertices[0])));
    largest = std::max(largest, glm::length(x));
  }
  return tolerance_for(error, extent, largest);
}

} // namespace meninas
