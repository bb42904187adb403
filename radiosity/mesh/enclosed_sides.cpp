#include "radiosity/mesh/enclosed_sides.h"

#include "radiosity/mesh/closed_bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

double volume_over(const TriangleCorners& base, const Point3& x) {
  return glm::dot(x - base[0], glm::cross(base[1] - base[0], base[2] - base[0]));
}

/// Whether the segment from p to q passes the triangle.
bool passes(const Point3& p, const Point3& q, const TriangleCorners& triangle) {
  const double from = volume_over(triangle, p), to = volume_over(triangle, q);
  if ((from > 0.0) == (to > 0.0))
    return false;
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k)
    left += glm::dot(q - p, glm::cross(triangle[k] - p, triangle[(k + 1) % 3] - p)) > 0.0 ? 1 : 0;
  return left == 0 || left == 3;
}

bool cross(const TriangleCorners& a, const TriangleCorners& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (passes(a[k], a[(k + 1) % 3], b) || passes(b[k], b[(k + 1) % 3], a))
      return true;
  return false;
}

/// Triangles that shine, a little above themselves and a little smaller, so that what only
/// stands on a body or leans against it does not reach into it; lamps without size as points.
std::vector<TriangleCorners> lamps_of(const Scene& scene, double above) {
  constexpr double smaller = 1e-3;
  std::vector<TriangleCorners> lamps;
  const auto add = [&](TriangleCorners lamp, const Vec3& up) {
    const Point3 middle = (lamp[0] + lamp[1] + lamp[2]) / 3.0;
    for (Point3& corner : lamp)
      corner = glm::mix(corner, middle, smaller) + up;
    lamps.push_back(lamp);
  };
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Material& material = material_of(scene, TriangleId{t});
    if (!is_emitter(material))
      continue;
    const TriangleCorners lamp = corners(scene, TriangleId{t});
    const Vec3 up = above * glm::normalize(area_vector(lamp));
    add(lamp, up);
    if (material.double_sided)
      add(lamp, -up);
  }
  for (const PunctualLight& light : scene.lights)
    if (light.kind != PunctualKind::directional)
      lamps.push_back({light.position, light.position, light.position});
  for (const AreaLight& light : scene.area_lights)
    for (std::size_t k = 2; k < light.corners.size(); ++k)
      add({light.corners[0], light.corners[k - 1], light.corners[k]}, above * light.axis);
  return lamps;
}

/// Whether a lamp is in the body, or it takes too long to tell.
bool may_hold(const ClosedBody& body, const std::vector<TriangleCorners>& lamps,
              std::size_t max_compared) {
  const Bounds around = bounds_of(body.shell);
  std::size_t compared = 0;
  return std::ranges::any_of(lamps, [&](const TriangleCorners& lamp) {
    const Bounds own = bounds_of({&lamp, 1});
    if (!overlap(own, around))
      return false;
    compared += body.shell.size();
    return compared > max_compared || winding_number(body.shell, lamp[0]) > 0.5 ||
           std::ranges::any_of(body.shell, [&](const TriangleCorners& part) {
             return overlap(own, bounds_of({&part, 1})) && cross(lamp, part);
           });
  });
}

/// Whether the body winds around what is behind its triangles once, and around what is before
/// them not, at some triangles all over it.
bool is_simple(const ClosedBody& body, double depth) {
  constexpr std::size_t max_angles = 1'000'000, least = 4, most = 256;
  const std::size_t size = body.triangles.size();
  const std::size_t asked =
      std::min(size, std::clamp(max_angles / body.shell.size(), least, most));
  for (std::size_t k = 0; k < asked; ++k) {
    const TriangleCorners& part = body.shell[k * size / asked];
    const Point3 middle = (part[0] + part[1] + part[2]) / 3.0;
    const Vec3 out = depth * glm::normalize(area_vector(part));
    const double inside = winding_number(body.shell, middle - out),
                 outside = winding_number(body.shell, middle + out);
    if (!(std::abs(inside - 1.0) < 0.5 && std::abs(outside) < 0.5))
      return false;
  }
  return true;
}

} // namespace

EnclosedSides find_enclosed_sides(const Scene& scene, const SurfaceModel& surfaces) {
  constexpr std::size_t max_compared = 20'000'000;
  EnclosedSides enclosed(scene.triangles.size(), {0, 0});
  std::vector<std::uint8_t> double_sided;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    double_sided.push_back(material_of(scene, TriangleId{t}).double_sided ? 1 : 0);
  if (std::ranges::find(double_sided, 1) == double_sided.end())
    return enclosed;
  const std::vector<ClosedBody> bodies = find_closed_bodies(scene, surfaces, double_sided);
  const double above = 4.0 * surfaces.tolerance;
  const std::vector<TriangleCorners> lamps = lamps_of(scene, above);
  tbb::parallel_for(std::size_t{0}, bodies.size(), [&](std::size_t b) {
    const ClosedBody& body = bodies[b];
    const auto passes_light = [&](TriangleId t) { return is_translucent(material_of(scene, t)); };
    if (std::ranges::any_of(body.triangles, passes_light) || !is_simple(body, above) ||
        may_hold(body, lamps, max_compared / bodies.size()))
      return;
    for (std::size_t k = 0; k < body.triangles.size(); ++k)
      enclosed[index(body.triangles[k])][body.looks_in[k] != 0 ? 0 : 1] = 1;
  });
  return enclosed;
}

} // namespace meninas
