#include "scenes/lamps.h"

#include "scenes/errors.h"
#include "scenes/names.h"
#include "scenes/sky/radiance_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace meninas {

namespace {

/// The lamp of that name, a new one where there is none.
std::uint32_t lamp_named(const std::string& name, LampGroups& lamps) {
  const auto lamp = static_cast<std::uint32_t>(std::ranges::find(lamps.names, name) - lamps.names.begin());
  if (lamp == lamps.size())
    lamps.names.push_back(name);
  return lamp;
}

/// That of what surrounds the scene: of its own, whatever lamps are called.
std::uint32_t lamp_beside(std::string name, LampGroups& lamps) {
  while (std::ranges::find(lamps.names, name) != lamps.names.end())
    name += " outside";
  return lamp_named(name, lamps);
}

void add_emitting_faces(const Scene& scene, LampGroups& lamps) {
  lamps.of_node.assign(scene.nodes.size(), no_lamp);
  lamps.of_material.assign(scene.materials.size(), no_lamp);
  for (const Triangle& triangle : scene.triangles) {
    if (!is_emitter(scene.materials[index(triangle.material)]) || triangle.node == none<NodeId>)
      continue;
    const Node& node = scene.nodes[index(triangle.node)];
    const bool by_material = lamps.grouping == LampGrouping::material;
    std::uint32_t& lamp = by_material ? lamps.of_material[index(triangle.material)]
                                      : lamps.of_node[index(triangle.node)];
    if (lamp != no_lamp)
      continue;
    const std::string& material = scene.materials[index(triangle.material)].name;
    lamp = lamp_named(by_material && !material.empty() ? material
                      : by_material || node.lamp.empty() ? node.name
                                                         : node.lamp,
                      lamps);
  }
}

RadianceMap relit(RadianceMap map, const Rgb& sky, const Rgb& sun) {
  // What suns are has their factor, the rest that of the sky: L = L_without + L_sun.
  if (map.without_suns.empty()) {
    for (glm::vec3& texel : map.texels)
      texel *= glm::vec3(sky);
  } else {
    for (std::size_t k = 0; k < map.texels.size(); ++k) {
      const glm::vec3 rest = glm::vec3(sky) * map.without_suns[k];
      map.texels[k] = rest + glm::vec3(sun) * (map.texels[k] - map.without_suns[k]);
      map.without_suns[k] = rest;
    }
  }
  for (DistantSun& one : map.suns)
    one.irradiance *= sun;
  return map;
}

} // namespace

std::uint32_t lamp_of(const LampGroups& lamps, NodeId node, MaterialId material) {
  if (lamps.grouping == LampGrouping::material)
    return lamps.of_material[index(material)];
  return node == none<NodeId> ? no_lamp : lamps.of_node[index(node)];
}

LampGroups find_lamps(const Scene& scene, LampGrouping grouping) {
  LampGroups lamps;
  lamps.grouping = grouping;
  add_emitting_faces(scene, lamps);
  for (const PunctualLight& light : scene.lights)
    lamps.of_light.push_back(lamp_named(light.lamp.empty() ? light.name : light.lamp, lamps));
  for (const AreaLight& light : scene.area_lights)
    lamps.of_area_light.push_back(lamp_named(light.lamp.empty() ? light.name : light.lamp, lamps));
  if (scene.background.map && !scene.background.map->suns.empty())
    lamps.sun = lamp_beside("sun", lamps);
  if (!is_dark(scene.background))
    lamps.sky = lamp_beside("sky", lamps);
  return lamps;
}

std::vector<Rgb> factors_of_lamps(std::span<const std::string> names,
                                  std::span<const LampFactor> given) {
  std::vector<Rgb> factors(names.size(), Rgb(1.0));
  for (const LampFactor& one : given) {
    const auto found = std::ranges::find(names, one.lamp);
    if (found != names.end())
      factors[static_cast<std::size_t>(found - names.begin())] = one.factor;
    else if (one.lamp == "all")
      std::ranges::fill(factors, one.factor);
    else if (names.empty())
      throw UsageError("--lamp", fmt::format("there is no lamp '{}': nothing emits", one.lamp));
    else
      throw UsageError("--lamp", fmt::format("there is no lamp '{}': there are {}", one.lamp,
                                             fmt::join(names, ", ")));
  }
  return factors;
}

Environment relit(const Environment& environment, const Rgb& sky, const Rgb& sun) {
  Environment other = environment;
  other.constant *= sky;
  if (environment.map && (sky != Rgb(1.0) || sun != Rgb(1.0)))
    other.map = std::make_shared<const RadianceMap>(relit(*environment.map, sky, sun));
  return other;
}

void relight_surroundings(Scene& scene, const LampGroups& lamps, std::span<const Rgb> factors) {
  for (std::size_t k = 0; k < scene.lights.size(); ++k)
    scene.lights[k].intensity *= factors[lamps.of_light[k]];
  for (std::size_t k = 0; k < scene.area_lights.size(); ++k)
    scene.area_lights[k].radiance *= factors[lamps.of_area_light[k]];
  const auto factor = [&](std::uint32_t lamp) { return lamp == no_lamp ? Rgb(1.0) : factors[lamp]; };
  scene.background = relit(scene.background, factor(lamps.sky), factor(lamps.sun));
}

Scene relit(Scene scene, const LampGroups& lamps, std::span<const Rgb> factors) {
  std::map<std::pair<MaterialId, std::uint32_t>, MaterialId> shining;
  std::vector<Material> materials = scene.materials;
  for (Triangle& triangle : scene.triangles) {
    if (!is_emitter(scene.materials[index(triangle.material)]))
      continue;
    const std::uint32_t lamp = lamp_of(lamps, triangle.node, triangle.material);
    if (lamp == no_lamp)
      continue;
    const auto [found, is_new] = shining.try_emplace(
        {triangle.material, lamp}, static_cast<MaterialId>(materials.size()));
    if (is_new) {
      materials.push_back(scene.materials[index(triangle.material)]);
      materials.back().emission *= factors[lamp];
    }
    triangle.material = found->second;
  }
  scene.materials = std::move(materials);
  relight_surroundings(scene, lamps, factors);
  return scene;
}

} // namespace meninas
