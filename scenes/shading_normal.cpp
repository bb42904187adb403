#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>

namespace meninas {

static std::array<double, 3> weights_of(Vec2 barycentric) {
  return {1.0 - barycentric.x - barycentric.y, barycentric.x, barycentric.y};
}

std::array<Direction, 3> corner_normals(const Scene& scene, TriangleId triangle) {
  constexpr double behind = 0.02; // a cosine; nearer to 90 degrees nothing is said of the front
  const Triangle& own = scene.triangles[index(triangle)];
  const Direction face = glm::normalize(area_vector(corners(scene, triangle)));
  std::array<Direction, 3> normals{face, face, face};
  if (!own.curved)
    return normals;
  std::array<Direction, 3> given{};
  for (std::size_t k = 0; k < 3; ++k)
    given[k] = Vec3(scene.vertices[index(own.vertices[k])].normal);
  const bool turned = std::ranges::all_of(
      given, [&](const Direction& n) { return glm::dot(n, face) < 0.0; });
  for (std::size_t k = 0; k < 3; ++k) {
    const Direction n = turned ? -given[k] : given[k];
    if (glm::dot(n, face) > behind)
      normals[k] = n;
  }
  return normals;
}

void mark_curved(Scene& scene, TriangleId triangle, double error) {
  Triangle& own = scene.triangles[index(triangle)];
  own.curved = true;
  const Direction face = glm::normalize(area_vector(corners(scene, triangle)));
  const double flat = std::max(min_curve, 1.5 * error);
  own.curved = std::ranges::any_of(corner_normals(scene, triangle), [&](const Direction& n) {
    return glm::distance(n, face) > flat;
  });
}

Direction shading_normal(const Scene& scene, TriangleId triangle, Vec2 barycentric) {
  // The corners' normals are all in front of the face, and so is any mean of them.
  const auto [n0, n1, n2] = corner_normals(scene, triangle);
  const auto [b0, b1, b2] = weights_of(barycentric);
  return glm::normalize(b0 * n0 + b1 * n1 + b2 * n2);
}

Direction visible_normal(const Direction& normal, const Direction& face, const Direction& out) {
  const double height = glm::dot(face, out);
  const double lowest = std::min(0.01, 0.9 * height);
  const Direction reflected = 2.0 * glm::dot(normal, out) * normal - out;
  const double above = glm::dot(face, reflected);
  if (above >= lowest || !(height > 0.0))
    return normal;
  // The lifted direction is as high over the face as `lowest`, wherever it was before.
  const Vec3 flat = reflected - above * face;
  const double length = glm::length(flat);
  if (!(length > 0.0))
    return face;
  const Direction lifted = std::sqrt(1.0 - lowest * lowest) / length * flat + lowest * face;
  return glm::normalize(out + lifted);
}

Point3 point_on_curve(const Scene& scene, TriangleId triangle, Vec2 barycentric, bool front) {
  const auto p = corners(scene, triangle);
  const auto normals = corner_normals(scene, triangle);
  const auto b = weights_of(barycentric);
  const Point3 flat = b[0] * p[0] + b[1] * p[1] + b[2] * p[2];
  Vec3 lift(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Direction n = front ? normals[k] : -normals[k];
    lift -= b[k] * std::min(0.0, glm::dot(n, flat - p[k])) * n;
  }
  return flat + lift;
}

Direction kept_above(const Direction& direction, const Direction& face) {
  const double height = glm::dot(direction, face);
  return height < 0.0 ? direction - 2.0 * height * face : direction;
}

} // namespace meninas
