#include "radiosity/scene/plan.h"

#include "scenes/names.h"

#include "scenes/sky/radiance_map.h"
#include "scenes/surfaces/closedness.h"
#include "radiosity/scene/enclosed_lights.h"
#include "radiosity/scene/mirror_depth_bound.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/materials/texture_lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <set>

namespace meninas {
namespace {

bool is_grey(const Rgb& colour) { return colour.r == colour.g && colour.g == colour.b; }

/// So smooth that what the metal throws has a shape, though pass one spreads it.
bool throws_shapes(const Material& material) {
  return is_glossy(material) && widest_roughness(material) <= smooth_metal_roughness &&
         !material.specular_in_pass_one;
}

/// The factor is rough, but texels may be smooth.
bool may_throw_shapes(const Material& material) {
  return is_glossy(material) && widest_roughness(material) > smooth_metal_roughness &&
         material.metallic_roughness_texture;
}

bool throws_sharply(const Material& material) {
  return is_glossy(material) && material.specular_in_pass_one;
}

bool throws_evenly(const Material& material) {
  return is_glossy(material) && !material.specular_in_pass_one;
}

bool has_even_coat(const Material& material) {
  return !is_glossy(material) && has_visible_coat(material) && !has_mirror_coat(material);
}

bool is_pane(const Material& material) { return is_glass(material) && !is_solid_glass(material); }

/// All of its light, reflected and passed, has no colour.
bool scatters_grey(const Material& material) {
  return is_grey(diffuse_reflectance(material)) && is_grey(mirror_reflectance(material)) &&
         is_grey(material.emission) && !is_textured(material) &&
         material.iridescence == 0.0 &&
         (!has_mirror_coat(material) || is_grey(material.specular_color)) &&
         (!is_translucent(material) || is_grey(material.diffuse_transmission_color)) &&
         (!is_glass(material) ||
          (is_grey(material.base_color) && is_grey(material.specular_color) &&
           is_grey(material.attenuation_color)));
}

/// Materials that are on some triangle of which that holds, by their place in the scene.
template <typename Predicate>
std::vector<const Material*> materials_where(const Scene& scene, Predicate&& holds) {
  std::set<MaterialId> used;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (holds(TriangleId{t})) {
      used.insert(scene.triangles[t].material);
    }
  }
  std::vector<const Material*> materials;
  for (const MaterialId id : used) {
    materials.push_back(&scene.materials[index(id)]);
  }
  return materials;
}

std::string plural(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

template <typename Predicate>
std::vector<std::string> names_where(const std::vector<const Material*>& materials,
                                     Predicate&& holds) {
  std::vector<std::string> names;
  for (const Material* material : materials) {
    if (holds(*material)) {
      names.push_back(material->name.empty() ? "unnamed" : material->name);
    }
  }
  return names;
}

std::vector<PlannedMirror> list_mirrors(const Scene& scene, const MirrorSet& mirrors) {
  std::vector<PlannedMirror> list;
  for (const Mirror& mirror : mirrors.mirrors) {
    constexpr std::size_t few = 6;
    std::vector<std::string> names;
    for (const NodeId node : mirror.nodes | std::views::take(few)) {
      names.push_back(scene.nodes[index(node)].name);
    }
    const std::size_t more = mirror.nodes.size() - names.size();
    list.push_back({fmt::format("{}{}", fmt::join(names, "+"),
                                more > 0 ? fmt::format(" and {} more", more) : ""),
                    mirror.area, mirror.reflectance});
  }
  return list;
}

std::size_t count_emitters(const Scene& scene, const SurfaceModel& surfaces) {
  std::size_t sides = 0;
  for (const Patch& patch : surfaces.patches) {
    const Material& material = scene.materials[index(patch.material)];
    if (is_emitter(material)) {
      sides += material.double_sided ? 2 : 1;
    }
  }
  return sides;
}

/// Nodes with mirror planes that are not enumerated, and how many planes each has.
std::map<NodeId, std::set<PlaneId>> faceted_nodes(const Scene& scene, const SurfaceModel& surfaces,
                                                  const MirrorSet& mirrors) {
  std::map<NodeId, std::set<PlaneId>> planes;
  for (std::size_t s = 0; s < surfaces.surfaces.size(); ++s) {
    const Surface& surface = surfaces.surfaces[s];
    const Material& material = scene.materials[index(surface.material)];
    const auto& faces = mirrors.mirror_of_surface[s];
    const bool is_facet = faces[0] == none<MirrorId> && faces[1] == none<MirrorId>;
    const bool reflects = is_mirror(material) || (is_glass(material) && !is_blended(material));
    if (!reflects || !is_facet) {
      continue;
    }
    for (const PatchId patch : surface.patches) {
      planes[surfaces.patches[index(patch)].node].insert(surface.plane_class);
    }
  }
  return planes;
}

/// In one line, however many there are.
void warn_of_facets(const Scene& scene, const SurfaceModel& surfaces, TransportPlan& plan) {
  std::vector<std::string> names;
  std::set<PlaneId> all;
  for (const auto& [node, planes] : faceted_nodes(scene, surfaces, plan.mirrors)) {
    names.push_back(scene.nodes[index(node)].name);
    all.insert(planes.begin(), planes.end());
  }
  if (names.empty()) {
    return;
  }
  plan.warnings.push_back(fmt::format(
      "{} {} of {}: followed by rays, not enumerated", quoted_names(names),
      names.size() == 1 ? "is a curved or faceted mirror" : "are curved, faceted or small mirrors",
      plural(all.size(), "plane")));
}

void warn_of_lights(const Scene& scene, TransportPlan& plan) {
  if (plan.emitters == 0 && scene.lights.empty() && scene.area_lights.empty() &&
      is_dark(scene.background)) {
    const bool shows = std::ranges::any_of(scene.materials, &Material::unlit);
    plan.warnings.push_back(fmt::format(
        "nothing emits light: {} will be black; --background 1 lights it from all around",
        shows ? "what is not unlit" : "the picture"));
  }
  const bool has_suns = scene.background.map && !scene.background.map->suns.empty();
  const bool has_points = !scene.lights.empty() || !scene.area_lights.empty() || has_suns;
  if (has_points && (plan.mirrors.facets > 0 || !plan.worlds.cut.empty())) {
    plan.warnings.push_back("point, spot, directional and area lights are reflected by enumerated "
                            "mirrors only; their light by small mirrors or longer chains is missing");
  }
  const auto solids =
      names_where(materials_where(scene, [](TriangleId) { return true; }), is_solid_glass);
  if (has_points && !solids.empty()) {
    plan.warnings.push_back("solid glass does not refract light of point, spot, directional and area "
                            "lights; it passes straight through: " +
                            quoted_names(solids));
  }
}

void warn_of_enclosed_lights(const Scene& scene, const SurfaceModel& surfaces,
                             TransportPlan& plan) {
  for (const auto& [light, body] : enclosed_lights(scene, surfaces)) {
    plan.warnings.push_back(fmt::format("the light '{}' is inside the closed opaque body '{}': "
                                        "nothing outside of it is lit by it",
                                        light, body));
  }
}

void warn_of_materials(const std::vector<const Material*>& materials, TransportPlan& plan) {
  if (const auto names = names_where(materials, throws_shapes); !names.empty()) {
    plan.warnings.push_back("light that smooth metals throw on other surfaces is spread evenly: " +
                            quoted_names(names));
  }
  if (const auto names = names_where(materials, may_throw_shapes); !names.empty()) {
    plan.warnings.push_back(
        "light that metals throw on other surfaces is spread evenly, also where "
        "a texture makes them smooth: " +
        quoted_names(names));
  }
  const auto is_frosted = [](const Material& m) {
    return is_pane(m) && !is_blended(m) && widest_roughness(m) > ideal_mirror_roughness;
  };
  if (const auto names = names_where(materials, is_frosted); !names.empty()) {
    plan.warnings.push_back("frosted glass lights other surfaces as clear glass would: " +
                            quoted_names(names));
  }
  const auto is_rough_solid = [](const Material& m) {
    return is_solid_glass(m) && widest_roughness(m) > ideal_mirror_roughness;
  };
  if (const auto names = names_where(materials, is_rough_solid); !names.empty()) {
    plan.warnings.push_back("the roughness of solid glass is ignored: " +
                            quoted_names(names));
  }
  const auto is_textured_mirror = [](const Material& m) { return is_mirror(m) && is_textured(m); };
  if (const auto names = names_where(materials, is_textured_mirror); !names.empty()) {
    plan.warnings.push_back("textures of mirrors are not applied to what they throw on surfaces: " +
                            quoted_names(names));
  }
}

/// At the vertices of glass colours tint it.
void warn_of_colored_mirrors(const Scene& scene, TransportPlan& plan) {
  const auto colored =
      materials_where(scene, [&](TriangleId t) { return has_vertex_colors(scene, t); });
  const auto is_metal_mirror = [](const Material& m) { return is_mirror(m) && !is_glass(m); };
  if (const auto names = names_where(colored, is_metal_mirror); !names.empty()) {
    plan.warnings.push_back("vertex colours of mirrors are not applied to what they reflect: " +
                            quoted_names(names));
  }
}

/// Lobes are followed in the picture alone.
void describe_lobes(const std::vector<const Material*>& materials,
                    std::vector<std::string>& stages) {
  if (const auto names = names_where(materials, throws_evenly); !names.empty()) {
    stages.push_back("glossy metals: grids of rays over their lobes in the picture, spread evenly "
                     "in pass one: " +
                     quoted_names(names));
  }
  if (const auto names = names_where(materials, throws_sharply); !names.empty()) {
    stages.push_back("smooth metals: grids of rays over their lobes in the picture, mirrors in "
                     "pass one: " +
                     quoted_names(names));
  }
  if (const auto names = names_where(materials, has_mirror_coat); !names.empty()) {
    stages.push_back("coats of large flat surfaces: rays over their lobes in the picture, mirrors "
                     "by Schlick in pass one: " +
                     quoted_names(names));
  }
  if (const auto names = names_where(materials, has_even_coat); !names.empty()) {
    stages.push_back("coats: rays over their lobes in the picture, spread evenly in pass one: " +
                     quoted_names(names));
  }
  if (const auto names = names_where(materials, is_pane); !names.empty()) {
    stages.push_back("glass panes: passed straight and reflecting as mirrors do, by Fresnel and "
                     "their tint, in both passes: " +
                     quoted_names(names));
  }
  if (const auto names = names_where(materials, is_translucent); !names.empty()) {
    stages.push_back(fmt::format(
        "translucent surfaces: {} diffuse light to the other side, in both "
        "passes: {}",
        names.size() == 1 ? "1 material passes" : fmt::format("{} materials pass", names.size()),
        quoted_names(names)));
  }
  if (const auto names = names_where(materials, is_solid_glass); !names.empty()) {
    stages.push_back("solid glass: refracted by Snell's law in both passes, lamps behind it found "
                     "by rays of their own: " +
                     quoted_names(names));
  }
}

/// The stages that will run, and why, in their order.
std::vector<std::string> describe_stages(const SurfaceModel& surfaces, const TransportPlan& plan,
                                         const std::vector<const Material*>& materials) {
  std::vector<std::string> stages;
  const std::size_t worlds = plan.worlds.worlds.size() - 1;
  stages.push_back(
      fmt::format("mesh: {} divided into elements", plural(surfaces.surfaces.size(), "surface")));
  if (worlds > 0) {
    stages.push_back(
        fmt::format("mirror worlds: {} of {}, {} deep", plural(worlds, "world"),
                    plural(plan.mirror_list.size(), "mirror"),
                    std::ranges::max(plan.worlds.worlds, {}, &MirrorWorld::depth).depth));
  }
  const bool mirrors = worlds > 0 || plan.mirrors.facets > 0;
  stages.push_back(mirrors ? "form factors: by rays, continued through mirrors"
                           : "form factors: by rays, no mirror to follow");
  if (plan.textured > 0) {
    stages.push_back(fmt::format(
        "textures: of {}, as means over elements in pass one, at every hit in the picture",
        plural(plan.textured, "material")));
  }
  if (plan.colored_triangles > 0) {
    stages.push_back(fmt::format("vertex colours: of {}, as means over elements, then at every hit",
                                 plural(plan.colored_triangles, "triangle")));
  }
  std::vector<std::string> sources;
  if (plan.emitters > 0) {
    sources.push_back(plural(plan.emitters, "emitter"));
  }
  if (plan.punctual_lights > 0) {
    sources.push_back(plural(plan.punctual_lights, "point, spot or directional light"));
  }
  if (plan.area_lights > 0) {
    sources.push_back(plural(plan.area_lights, "area light") + " that mirrors alone show");
  }
  if (!sources.empty()) {
    stages.push_back(fmt::format("direct light: {}{}", fmt::join(sources, " and "),
                                 worlds > 0 ? ", also seen in mirrors" : ""));
  }
  stages.push_back(
      fmt::format("solve: {}", plan.bands == 1 ? "one band, all is grey" : "three bands"));
  stages.push_back("interpolation: irradiance between the vertices of the elements");
  stages.push_back(mirrors ? "picture: camera rays, followed through mirrors"
                           : "picture: camera rays, no mirror to follow");
  describe_lobes(materials, stages);
  return stages;
}

} // namespace

TransportPlan plan_transport(const Scene& scene, const SurfaceModel& surfaces,
                             const PlanSettings& settings) {
  TransportPlan plan;
  plan.mirrors = find_mirrors(scene, surfaces, settings.mirrors);
  plan.worlds = mirror_worlds(plan.mirrors, settings.worlds);
  plan.mirror_depth_bound = mirror_depth_bound(plan.worlds, plan.mirrors, receiving_area(scene, surfaces));
  plan.mirror_list = list_mirrors(scene, plan.mirrors);
  plan.emitters = count_emitters(scene, surfaces);
  plan.punctual_lights = scene.lights.size();
  plan.area_lights = scene.area_lights.size();

  const auto materials = materials_where(scene, [](TriangleId) { return true; });
  const auto count = [&](auto&& holds) {
    return static_cast<std::size_t>(std::ranges::count_if(
        materials, holds, [](const Material* m) -> const Material& { return *m; }));
  };
  plan.glossy = count(is_glossy);
  plan.transmissive = count(is_glass);
  plan.textured = count(is_textured);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    plan.colored_triangles += has_vertex_colors(scene, TriangleId{t}) ? 1 : 0;
  }
  const std::size_t grey = count(scatters_grey);
  const bool grey_light = is_grey(scene.background) &&
                          std::ranges::all_of(scene.lights, [](const PunctualLight& light) {
                            return is_grey(light.intensity);
                          }) &&
                          std::ranges::all_of(scene.area_lights, [](const AreaLight& light) {
                            return is_grey(light.radiance);
                          });
  const bool grey_vertices = std::ranges::all_of(scene.vertices, [&](const Vertex& vertex) {
    return is_grey(Rgb(attributes_of(scene, vertex).color));
  });
  plan.bands = grey == materials.size() && grey_light && grey_vertices ? 1 : 3;
  plan.closed = is_closed(scene, 0.5 * surfaces.tolerance);

  plan.ignored = scene.ignored;
  plan.warnings = scene.warnings;
  warn_of_lights(scene, plan);
  warn_of_enclosed_lights(scene, surfaces, plan);
  if (scene.cameras.empty()) {
    plan.warnings.push_back("no camera: a default view of the whole scene is used");
  }
  warn_of_materials(materials, plan);
  warn_of_colored_mirrors(scene, plan);
  warn_of_facets(scene, surfaces, plan);
  plan.stages = describe_stages(surfaces, plan, materials);
  if (const std::string sky = description(scene.background); !sky.empty()) {
    plan.stages.insert(plan.stages.begin(), "sky: " + sky);
  }
  return plan;
}

} // namespace meninas
