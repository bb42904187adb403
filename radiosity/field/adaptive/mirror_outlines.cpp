#include "radiosity/field/adaptive/mirror_outlines.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace meninas {

namespace {

/// Where the line from the apex through x, beyond x, meets a plane from its lit side.
std::optional<Point3> projected(const Point3& apex, const Point3& x, const Plane& plane) {
  const double from = signed_distance(plane, apex), at = signed_distance(plane, x);
  if (!(from > at) || at < 0.0)
    return std::nullopt;
  return apex + from / (from - at) * (x - apex);
}

/// The part of the segment from a to b inside a convex polygon with that normal.
std::optional<std::array<Point3, 2>> clipped(Point3 a, Point3 b, std::span<const Point3> polygon,
                                             const Direction& normal) {
  double first = 0.0, last = 1.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 inward = glm::cross(normal, polygon[(k + 1) % polygon.size()] - polygon[k]);
    const double at_a = glm::dot(inward, a - polygon[k]), at_b = glm::dot(inward, b - polygon[k]);
    if (at_a < 0.0 && at_b < 0.0)
      return std::nullopt;
    if (at_a < 0.0)
      first = std::max(first, at_a / (at_a - at_b));
    if (at_b < 0.0)
      last = std::min(last, at_a / (at_a - at_b));
  }
  if (first >= last)
    return std::nullopt;
  return std::array{glm::mix(a, b, first), glm::mix(a, b, last)};
}

/// The outline of one window from one point, on all sides.
void add_outline(const LightScene& light, const Point3& apex, const ConvexPolygon& window,
                 double spacing, MirrorOutlines& outlines) {
  for (std::size_t s = 0; s < light.mesh.sides.size(); ++s) {
    const MeshSide& side = light.mesh.sides[s];
    const Patch& patch = light.surfaces.patches[index(side.patch)];
    const Direction front = side.facing == Facing::front ? side.normal : -side.normal;
    for (std::size_t k = 0; k < window.size; ++k) {
      const auto a = projected(apex, window.vertices[k], side.plane),
                 b = projected(apex, window.vertices[(k + 1) % window.size], side.plane);
      if (!a || !b)
        continue;
      const auto part = clipped(*a, *b, polygon_of(patch), front);
      if (!part)
        continue;
      const double length = glm::distance((*part)[0], (*part)[1]);
      const int steps = static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, 1e4));
      for (int step = 0; step <= steps; ++step)
        outlines.push_back({static_cast<SideId>(s),
                            uv_at(patch, glm::mix((*part)[0], (*part)[1], double(step) / steps))});
    }
  }
}

} // namespace

MirrorOutlines mirror_outlines(const LightScene& light, double spacing, std::size_t most) {
  struct Pair {
    std::uint32_t world, emitter;
    double power;
  };
  std::vector<Pair> pairs;
  for (std::uint32_t w = 1; w < light.worlds.worlds.size(); ++w)
    for (std::uint32_t e = 0; e < light.emitters.size(); ++e)
      pairs.push_back({w, e,
                       light.emitters[e].area * largest(light.emitters[e].radiosity *
                                                        light.worlds.worlds[w].throughput)});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.power > b.power; });
  pairs.resize(std::min(pairs.size(), most));

  // Every window on the way cuts the light;
  // all of them lie in the unfolded space of the receiver, as the image does.
  MirrorOutlines outlines;
  for (const Pair& pair : pairs) {
    const Isometry& image = light.worlds.worlds[pair.world].image;
    for (const Point3& corner : light.emitters[pair.emitter].polygon.span())
      for (WorldId w{pair.world}; w != real_world; w = light.worlds.worlds[index(w)].parent)
        for (const ConvexPolygon& window : light.worlds.worlds[index(w)].window)
          add_outline(light, apply(image, corner), window, spacing, outlines);
  }
  return outlines;
}

} // namespace meninas
