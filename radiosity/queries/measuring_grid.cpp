#include "radiosity/queries/measuring_grid.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace meninas {

namespace {

constexpr std::size_t max_grid_faces = 64, max_grid_points = 1'000'000;
constexpr double max_tests = 2e9; ///< of points against patches: some ten seconds

/// A rectangle in the plane of a face: corner + [0, a] u + [0, b] v.
struct Rectangle {
  Point3 corner{0.0};
  Direction u{0.0}, v{0.0};
  double a = 0.0, b = 0.0;
};

using Patches = std::vector<const Patch*>;

std::span<const Point3> corners_of(const Patch& patch) {
  return std::span(patch.corners).first(static_cast<std::size_t>(patch.corner_count));
}

/// Around all corners, with sides along and across `u`.
Rectangle around(const Patches& patches, const Direction& u, const Direction& normal) {
  const Direction v = glm::cross(normal, u);
  const Point3 origin = patches.front()->corners[0];
  Vec2 low(0.0), high(0.0);
  for (const Patch* patch : patches)
    for (const Point3& corner : corners_of(*patch)) {
      const Vec2 place(glm::dot(corner - origin, u), glm::dot(corner - origin, v));
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
  return {origin + low.x * u + low.y * v, u, v, high.x - low.x, high.y - low.y};
}

/// One side of the smallest lies along an edge of the convex hull (Freeman and Shapira 1975), and
/// edges of the hull of a face with straight outlines are edges of its patches.
Rectangle smallest_around(const Patches& patches, const Direction& normal) {
  constexpr std::size_t edges_tried = 512;
  Rectangle smallest;
  std::size_t tried = 0;
  for (const Patch* patch : patches) {
    const auto corners = corners_of(*patch);
    for (std::size_t k = 0; k < corners.size() && tried < edges_tried; ++k, ++tried) {
      const Vec3 edge = corners[(k + 1) % corners.size()] - corners[k];
      if (!(glm::length(edge) > 0.0))
        continue;
      const Rectangle rectangle = around(patches, glm::normalize(edge), normal);
      // A hair, so that rounding does not choose among edges that are parallel.
      if (smallest.a == 0.0 || rectangle.a * rectangle.b < (1.0 - 1e-9) * smallest.a * smallest.b)
        smallest = rectangle;
    }
  }
  if (smallest.a < smallest.b) {
    smallest.corner += smallest.b * smallest.v;
    smallest = {smallest.corner, -smallest.v, smallest.u, smallest.b, smallest.a};
  }
  return smallest;
}

/// In a convex polygon or on its edge.
bool is_over(const Patch& patch, const Point3& x, const Direction& normal) {
  const auto corners = corners_of(patch);
  const double rounding = -1e-9 * patch.area;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 edge = corners[(k + 1) % corners.size()] - corners[k];
    if (glm::dot(glm::cross(edge, x - corners[k]), normal) < rounding)
      return false;
  }
  return true;
}

double rounded_count(double x) { return std::max(1.0, std::round(x)); }

/// The numbers of points of a grid along the longer and the shorter side, which may exceed the range of an int.
std::pair<double, double> counts(double length, double width) {
  const double p = grid_spacing(length, width);
  const bool narrow = length >= 2.0 * width;
  const double d = narrow ? width : length, other = narrow ? length : width;
  const double along_d = rounded_count(d / p);
  const double along_other = rounded_count(other / (d / along_d));
  return narrow ? std::pair{along_other, along_d} : std::pair{along_d, along_other};
}

/// None where the margins leave nothing, or no point is over the face.
std::optional<MeasuringGrid> grid_on(const Patches& patches, const Direction& normal,
                                     const std::string& node, const GridSettings& settings) {
  const Rectangle all = smallest_around(patches, normal);
  MeasuringGrid grid{.node = node,
                     .length = all.a - 2.0 * settings.margin,
                     .width = all.b - 2.0 * settings.margin};
  if (!(grid.width > 0.0))
    return std::nullopt;
  const auto [along, across] = counts(grid.length, grid.width);
  const double count = along * across;
  if (!(count <= double(max_grid_points)) || count * double(patches.size()) > max_tests)
    throw UsageError("--grid", fmt::format("node '{}' would have {:g} x {:g} points", node, along, across));
  grid.along = static_cast<std::size_t>(along);
  grid.across = static_cast<std::size_t>(across);
  for (std::size_t j = 0; j < grid.across; ++j)
    for (std::size_t i = 0; i < grid.along; ++i) {
      const double s = settings.margin + (double(i) + 0.5) * grid.length / double(grid.along);
      const double t = settings.margin + (double(j) + 0.5) * grid.width / double(grid.across);
      const Point3 x = all.corner + s * all.u + t * all.v;
      if (std::ranges::any_of(patches, [&](const Patch* p) { return is_over(*p, x, normal); }))
        grid.points.push_back({x + settings.height * normal, normal});
    }
  return grid.points.empty() ? std::nullopt : std::optional(std::move(grid));
}

} // namespace

double grid_spacing(double length, double width) {
  constexpr double widest = 10.0;
  const double longer = std::max(length, width), shorter = std::min(length, width);
  const double d = longer >= 2.0 * shorter ? shorter : longer;
  return std::min(widest, 0.2 * std::pow(5.0, std::log10(d)));
}

std::vector<MeasuringGrid> measuring_grids(const Scene& scene, const SurfaceModel& surfaces,
                                           const std::string& node, const GridSettings& settings) {
  const NodeId asked = find_node(scene, node);
  std::map<SurfaceId, Patches> faces;
  for (const Patch& patch : surfaces.patches)
    if (patch.node == asked)
      faces[patch.surface].push_back(&patch);
  if (faces.size() > max_grid_faces)
    throw UsageError("--grid", fmt::format("node '{}' has {} flat faces; grids are for nodes with at most {}",
                                           node, faces.size(), max_grid_faces));
  std::vector<MeasuringGrid> grids;
  std::size_t number = 0;
  for (const auto& [surface, patches] : faces) {
    ++number;
    const Surface& face = surfaces.surfaces[index(surface)];
    std::optional<MeasuringGrid> front = grid_on(patches, face.plane.normal, node, settings);
    if (!front)
      continue;
    front->face = faces.size() > 1 ? number : 0;
    grids.push_back(std::move(*front));
    if (!scene.materials[index(face.material)].double_sided)
      continue;
    MeasuringGrid back = grids.back();
    for (QueryPoint& point : back.points)
      point = {point.position - 2.0 * settings.height * face.plane.normal, -point.normal};
    back.back = true;
    grids.push_back(std::move(back));
  }
  if (grids.empty())
    throw UsageError("--grid", fmt::format("node '{}' has no room for a point{}", node,
                                           settings.margin > 0.0 ? " within --grid-margin" : ""));
  std::size_t points = 0;
  for (const MeasuringGrid& grid : grids)
    points += grid.points.size();
  if (points > max_grid_points)
    throw UsageError("--grid", fmt::format("node '{}' would have {} points", node, points));
  return grids;
}

GridSummary summary_of(std::span<const double> values) {
  if (values.empty())
    return {};
  GridSummary summary{values.front(), 0.0, values.front(), 0.0};
  for (const double value : values) {
    summary.minimum = std::min(summary.minimum, value);
    summary.maximum = std::max(summary.maximum, value);
    summary.mean += value;
  }
  summary.mean /= double(values.size());
  summary.uniformity = summary.mean > 0.0 ? summary.minimum / summary.mean : 0.0;
  return summary;
}

} // namespace meninas
