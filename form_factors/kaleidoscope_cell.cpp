#include "form_factors/kaleidoscope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meninas {

namespace {

/// More corners or mirrors than rooms and ducts have are left to the general method.
constexpr std::size_t max_corners = 40, max_mirrors = 12;

struct Hull {
  std::vector<Point3> corners;
  std::vector<Plane> sides; ///< normals to the outside
};

void append_new(std::vector<Point3>& corners, const ConvexPolygon& polygon, double tolerance) {
  for (const Point3& x : polygon.span())
    if (std::none_of(corners.begin(), corners.end(),
                     [&](const Point3& known) { return glm::distance(x, known) <= tolerance; }))
      corners.push_back(x);
}

/// The planes through three corners that have all others on one side.
std::vector<Plane> supporting_planes(const std::vector<Point3>& corners, double tolerance) {
  std::vector<Plane> planes;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        const Vec3 cross = glm::cross(corners[j] - corners[i], corners[k] - corners[i]);
        const double length = glm::length(cross);
        if (length <= tolerance * glm::distance(corners[i], corners[j]))
          continue;
        Plane plane{cross / length, glm::dot(cross / length, corners[i])};
        double above = 0.0, below = 0.0;
        for (const Point3& x : corners) {
          above = std::max(above, signed_distance(plane, x));
          below = std::max(below, -signed_distance(plane, x));
        }
        if (above > tolerance && below > tolerance)
          continue;
        if (above > tolerance)
          plane = {-plane.normal, -plane.offset};
        const bool is_new = std::none_of(planes.begin(), planes.end(), [&](const Plane& known) {
          return glm::dot(known.normal, plane.normal) > 1.0 - 1e-12 &&
                 std::abs(known.offset - plane.offset) <= tolerance;
        });
        if (is_new)
          planes.push_back(plane);
      }
  return planes;
}

bool all_behind(std::span<const Point3> points, const Plane& plane, double tolerance) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Point3& x) { return signed_distance(plane, x) <= tolerance; });
}

bool all_in_front(std::span<const Point3> points, const Plane& plane, double tolerance) {
  return all_behind(points, {-plane.normal, -plane.offset}, tolerance);
}

/// Whether the face stays out of the hull's inside.
bool stays_outside(const Face& face, const Hull& hull, double tolerance) {
  if (all_behind(hull.corners, face.plane, tolerance) ||
      all_in_front(hull.corners, face.plane, tolerance))
    return true;
  return std::any_of(hull.sides.begin(), hull.sides.end(), [&](const Plane& side) {
    return all_in_front(face.polygon.span(), side, tolerance);
  });
}

/// Whether the window is all of the hull's side in the mirror's plane.
bool fills_its_side(const Mirror& mirror, const Hull& hull, double tolerance) {
  if (mirror.window.size() != 1)
    return false;
  const ConvexPolygon& window = mirror.window.front();
  for (const Point3& x : hull.corners) {
    if (signed_distance(mirror.plane, x) > tolerance)
      continue;
    for (std::size_t k = 0; k < window.size; ++k) {
      const Point3& from = window.vertices[k];
      const Vec3 edge = window.vertices[k + 1 < window.size ? k + 1 : 0] - from;
      const Vec3 inward = glm::cross(mirror.plane.normal, edge);
      if (glm::dot(inward, x - from) < -tolerance * glm::length(edge))
        return false;
    }
  }
  return true;
}

/// The angle at an edge of the mirror between it and the hull's next side.
double dihedral_angle(const Mirror& mirror, const Point3& from, const Point3& to, const Hull& hull,
                      double tolerance) {
  const Direction inward = glm::normalize(glm::cross(mirror.plane.normal, to - from));
  double angle = 0.0;
  for (const Point3& x : hull.corners) {
    const double height = signed_distance(mirror.plane, x);
    if (height > tolerance)
      angle = std::max(angle, std::atan2(height, glm::dot(inward, x - from)));
  }
  return angle;
}

enum class Corner { tiles, mirrors_tile, fails };

/// Whether images fit together around one edge of a mirror.
Corner corner_at(const WorldView& view, const Mirror& mirror, const Point3& from, const Point3& to,
                 const Hull& hull) {
  constexpr double rounding = 1e-9;
  const double angle = dihedral_angle(mirror, from, to, hull, view.tolerance);
  for (const Mirror& other : view.mirrors.mirrors) {
    if (&other == &mirror || std::abs(signed_distance(other.plane, from)) > view.tolerance ||
        std::abs(signed_distance(other.plane, to)) > view.tolerance)
      continue;
    const double between =
        std::acos(std::clamp(-glm::dot(mirror.plane.normal, other.plane.normal), -1.0, 1.0));
    if (std::abs(between - angle) > rounding)
      continue;
    // An odd number of sectors has an image with as many
    // reflections in one mirror as in the other, but for one.
    const double sectors = std::numbers::pi / between;
    const double n = std::round(sectors);
    const bool odd = std::fmod(n, 2.0) != 0.0;
    const bool tiles = n >= 2.0 && std::abs(sectors - n) <= rounding * n;
    return tiles && (!odd || mirror.reflectance == other.reflectance) ? Corner::mirrors_tile
                                                                      : Corner::fails;
  }
  return angle <= 0.5 * std::numbers::pi + rounding ? Corner::tiles : Corner::fails;
}

Hull hull_of(const WorldView& view, const std::vector<Face>& from) {
  Hull hull;
  for (const Face& face : from)
    append_new(hull.corners, face.polygon, view.tolerance);
  for (const Face& face : view.targets)
    append_new(hull.corners, face.polygon, view.tolerance);
  for (const Mirror& mirror : view.mirrors.mirrors)
    for (const ConvexPolygon& part : mirror.window)
      append_new(hull.corners, part, view.tolerance);
  if (hull.corners.size() <= max_corners)
    hull.sides = supporting_planes(hull.corners, view.tolerance);
  return hull;
}

} // namespace

std::optional<KaleidoscopeCell> find_kaleidoscope(const WorldView& view,
                                                  const std::vector<Face>& from) {
  if (view.mirrors.mirrors.empty() || view.mirrors.mirrors.size() > max_mirrors)
    return std::nullopt;

  // All mirrors are in the hull: light that leaves it elsewhere meets none of them again.
  const Hull hull = hull_of(view, from);
  if (hull.sides.empty())
    return std::nullopt;
  for (const Face& face : view.blockers)
    if (!stays_outside(face, hull, view.tolerance))
      return std::nullopt;

  KaleidoscopeCell cell;
  for (std::size_t m = 0; m < view.mirrors.mirrors.size(); ++m) {
    const Mirror& mirror = view.mirrors.mirrors[m];
    if (all_behind(hull.corners, mirror.plane, view.tolerance))
      continue; // it shows its back
    if (!all_in_front(hull.corners, mirror.plane, view.tolerance) ||
        !fills_its_side(mirror, hull, view.tolerance))
      return std::nullopt;
    const ConvexPolygon& window = mirror.window.front();
    for (std::size_t k = 0; k < window.size; ++k) {
      const Corner corner = corner_at(view, mirror, window.vertices[k],
                                      window.vertices[k + 1 < window.size ? k + 1 : 0], hull);
      if (corner == Corner::fails)
        return std::nullopt;
      cell.corners |= corner == Corner::mirrors_tile;
    }
    cell.walls.push_back(static_cast<MirrorId>(m));
  }

  for (const Point3& x : hull.corners)
    cell.inside += x / static_cast<double>(hull.corners.size());
  cell.clearance = std::numeric_limits<double>::infinity();
  for (const MirrorId wall : cell.walls)
    cell.clearance = std::min(
        cell.clearance, signed_distance(view.mirrors.mirrors[index(wall)].plane, cell.inside));
  if (cell.walls.empty() || cell.clearance <= 10.0 * view.tolerance)
    return std::nullopt;
  return cell;
}

} // namespace meninas
