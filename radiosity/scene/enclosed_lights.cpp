#include "radiosity/scene/enclosed_lights.h"

#include "radiosity/mesh/closed_bodies.h"

#include <algorithm>

namespace meninas {

namespace {

constexpr double room_share = 0.5; ///< of the scene's diagonal

bool holds(const Bounds& bounds, const Point3& x) {
  return glm::all(glm::lessThan(bounds.low, x)) && glm::all(glm::lessThan(x, bounds.high));
}

bool passes_light(const Scene& scene, const ClosedBody& body) {
  return std::ranges::any_of(body.triangles,
                             [&](TriangleId t) { return is_translucent(material_of(scene, t)); });
}

bool is_room(const Scene& scene, const ClosedBody& body, const Bounds& bounds, double diagonal) {
  if (glm::distance(bounds.low, bounds.high) > room_share * diagonal)
    return true;
  for (std::size_t k = 0; k < body.triangles.size(); ++k)
    if (body.looks_in[k] != 0 && !material_of(scene, body.triangles[k]).double_sided)
      return true;
  return false;
}

/// A light that has a place.
struct PlacedLight {
  std::string name;
  Point3 position;
};
std::vector<PlacedLight> placed_lights(const Scene& scene) {
  std::vector<PlacedLight> placed;
  for (const PunctualLight& light : scene.lights)
    if (light.kind != PunctualKind::directional)
      placed.push_back({light.name, light.position});
  for (const AreaLight& light : scene.area_lights) {
    Point3 middle(0.0);
    for (const Point3& corner : light.corners)
      middle += corner / double(light.corners.size());
    placed.push_back({light.name, middle});
  }
  return placed;
}

} // namespace

std::vector<EnclosedLight> enclosed_lights(const Scene& scene, const SurfaceModel& surfaces) {
  const std::vector<PlacedLight> lights = placed_lights(scene);
  if (lights.empty() || scene.triangles.empty())
    return {};
  const Bounds all = bounds_of(scene);
  const double diagonal = glm::distance(all.low, all.high);
  std::vector<EnclosedLight> enclosed;
  const std::vector<std::uint8_t> wanted(scene.triangles.size(), 1);
  const std::vector<ClosedBody> bodies = find_closed_bodies(scene, surfaces, wanted);
  for (const PlacedLight& light : lights) {
    const auto holder = std::ranges::find_if(bodies, [&](const ClosedBody& body) {
      const Bounds bounds = bounds_of(body.shell);
      const auto is_inside = [&](const Point3& x) {
        return holds(bounds, x) && winding_number(body.shell, x) > 0.5;
      };
      return is_inside(light.position) && !passes_light(scene, body) &&
             !is_room(scene, body, bounds, diagonal) &&
             std::ranges::none_of(scene.cameras, is_inside, &Camera::position);
    });
    if (holder == bodies.end())
      continue;
    const NodeId node = scene.triangles[index(holder->triangles.front())].node;
    enclosed.emplace_back(light.name, scene.nodes[index(node)].name);
  }
  return enclosed;
}

} // namespace meninas
