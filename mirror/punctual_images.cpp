#include "mirror/punctual_images.h"

#include <algorithm>

namespace meninas {

namespace {

Point3 inverse(const Isometry& map, const Point3& x) {
  return glm::transpose(map.linear) * (x - map.translation);
}

/// Whether the line from the apex to y passes the window, of either orientation;
/// its edges belong to it.
bool passes(const ConvexPolygon& window, const Point3& apex, const Point3& y) {
  bool left = true, right = true;
  for (std::size_t k = 0; k < window.size; ++k) {
    const Vec3 a = window.vertices[k] - apex, b = window.vertices[(k + 1) % window.size] - apex;
    const double side = glm::dot(glm::cross(a, b), y - apex);
    left = left && side >= 0.0;
    right = right && side <= 0.0;
  }
  return left || right;
}

bool is_seen(const MirrorWorld& world, const SeenWorlds& seen, const SeenWorld& at,
             const Point3& from, const Point3& y) {
  if (world.depth == 0)
    return true;
  if (signed_distance(world.plane, y) >= 0.0)
    return false;
  const auto openings = std::span(seen.openings).subspan(at.first, at.last - at.first);
  return std::ranges::any_of(openings,
                             [&](const ConvexPolygon& part) { return passes(part, from, y); });
}

} // namespace

void punctual_images(const WorldTree& tree, std::span<const PunctualLight> lights,
                     const SeenWorlds& seen, const Observer& observer, double reach,
                     std::vector<PunctualImage>& images) {
  images.clear();
  for (const SeenWorld& at : seen.worlds) {
    const MirrorWorld& world = tree.worlds[index(at.world)];
    for (std::uint32_t number = 0; number < lights.size(); ++number) {
      const PunctualLight& light = lights[number];
      // A light that shines on the observer's image in the real
      // room shines on the observer from the light's image.
      const PunctualSample real =
          punctual_sample(light, inverse(world.image, observer.position), reach);
      const Point3 position = apply(world.image, real.position);
      const Vec3 to = position - observer.position;
      const double cosine = glm::dot(to, observer.normal) / glm::length(to);
      if (!(cosine > 0.0) || real.irradiance == Rgb(0.0) ||
          !is_seen(world, seen, at, observer.position, position))
        continue;
      images.push_back({at.world, position, cosine * real.irradiance, number});
    }
  }
}

} // namespace meninas
