#include "raytrace/footprint.h"

#include <algorithm>
#include <cmath>

namespace meninas {

/// s, in units of the frame of the ray scene.
static double beam_width(const RenderContext& context, double t, double length) {
  const CameraFrame& camera = context.camera;
  const double wide =
      (glm::length(camera.origin_x) + t * glm::length(camera.direction_x)) / context.settings.width;
  const double high = (glm::length(camera.origin_y) + t * glm::length(camera.direction_y)) /
                      context.settings.height;
  return std::sqrt(wide * high / (context.footprint_samples * length));
}

Footprint footprint_of(const LandedLane& lane) {
  const auto& [context, packet, state, face, hits, k] = lane;
  const Vec3 d(packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]);
  const double length = glm::length(d);
  const double t = double{hits.distance[k]} + double{state.travelled(k)};
  const LightScene& light = context.light;
  const double width = beam_width(context, t, length) / light.rays.frame().scale;

  // The sides: across the ray, and along its shadow on the surface. Head on, any two will do.
  constexpr double grazing = 1e-3;
  const double cosine = std::max(grazing, std::abs(glm::dot(face.normal, d)) / length);
  const Vec3 across = glm::cross(face.normal, d);
  const bool head_on = glm::length(across) < 1e-6 * length;
  const auto [a, b, c] = corners(light.scene, TriangleId{hits.triangle[k]});
  const Vec3 shorter = glm::normalize(head_on ? b - a : across);
  const Vec3 longer = glm::cross(shorter, face.normal);

  // Weights b1, b2 of a vector v in the plane: v = b1 e1 + b2 e2.
  const Vec3 e1 = b - a, e2 = c - a;
  const double g11 = glm::dot(e1, e1), g12 = glm::dot(e1, e2), g22 = glm::dot(e2, e2);
  const double det = g11 * g22 - g12 * g12;
  if (!(det > 0.0))
    return {};
  const auto weights = [&](const Vec3& v) {
    const double v1 = glm::dot(v, e1), v2 = glm::dot(v, e2);
    return Vec2(g22 * v1 - g12 * v2, g11 * v2 - g12 * v1) / det;
  };
  return {weights(width / cosine * longer), weights(width * shorter)};
}

} // namespace meninas
