#include "radiosity/scene/light_scene.h"

#include "radiosity/scene/cut_out_mirrors.h"
#include "radiosity/mesh/small_surfaces.h"
#include "radiosity/scene/surface_colour.h"
#include "scenes/area_light.h"
#include "scenes/sky/radiance_map.h"

#include <algorithm>
#include <numbers>

namespace meninas {

namespace {

constexpr double large_emitter_share = 0.5;

bool emits(const MeshSide& side) { return glm::any(glm::greaterThan(side.emission, Rgb(0.0))); }

Emitter make_emitter(const MeshSide& side, std::span<const Point3> polygon, const Rgb& radiosity,
                     double area) {
  Emitter emitter;
  emitter.corners.assign(polygon.begin(), polygon.end());
  if (side.facing == Facing::back)
    std::ranges::reverse(emitter.corners);
  emitter.plane = side.plane;
  emitter.plane_class = side.plane_class;
  emitter.radiosity = radiosity;
  emitter.area = area;
  return emitter;
}

/// A side that glows evenly is one emitter; of a textured one every element is.
void add_emitters(const SurfaceModel& surfaces, const ElementMesh& mesh, const MeshSide& side,
                  std::vector<Emitter>& emitters) {
  if (!side.textured) {
    const Patch& patch = surfaces.patches[index(side.patch)];
    emitters.push_back(make_emitter(side, polygon_of(patch), side.emission, patch.area));
    return;
  }
  for (std::uint32_t e = side.first_element; e < side.first_element + side.element_count; ++e) {
    if (mesh.emission[e] == Rgb(0.0) || mesh.solid[e] == 0.0F)
      continue;
    if (const RegionElement* region = region_of(mesh, ElementId{e})) {
      for (auto triangle : region->triangles) {
        if (side.facing == Facing::back) // they turn as seen from the side's own light
          std::swap(triangle[1], triangle[2]);
        emitters.push_back(make_emitter(side, triangle, double{mesh.solid[e]} * mesh.emission[e],
                                        glm::length(area_vector(triangle))));
      }
      continue;
    }
    std::vector<Point3> corners;
    for (std::size_t c = 0; c < (side.triangle ? 3U : 4U); ++c)
      corners.push_back(mesh.vertices[index(mesh.corners[e][c])]);
    emitters.push_back(
        make_emitter(side, corners, double{mesh.solid[e]} * mesh.emission[e], mesh.area[e]));
  }
}

} // namespace

bool grey_mirrors(const Scene& scene) {
  const auto is_grey = [](const Rgb& c) { return c.r == c.g && c.g == c.b; };
  const bool colored = std::ranges::any_of(scene.vertices, [&](const Vertex& vertex) {
    return !is_grey(Rgb(attributes_of(scene, vertex).color));
  });
  return std::ranges::all_of(scene.materials, [&](const Material& material) {
    if (material.iridescence > 0.0 && (has_mirror_coat(material) || is_glass(material)))
      return false;
    if (has_mirror_coat(material))
      return is_grey(material.specular_color);
    if (!is_glass(material))
      return is_grey(mirror_reflectance(material));
    return is_grey(material.base_color) && is_grey(material.specular_color) &&
           is_grey(material.attenuation_color) && !is_textured(material) && !colored;
  });
}

/// As `LightScene::by_angle`.
static std::vector<Bsdf> reflecting_by_angle(const Scene& scene) {
  std::vector<Bsdf> bsdfs;
  if (std::ranges::any_of(scene.materials, is_glass) ||
      std::ranges::any_of(scene.materials, has_mirror_coat))
    for (const Material& material : scene.materials)
      bsdfs.push_back(has_mirror_coat(material) ? mirror_coat(material)
                                                : clear_glass(material, untextured(material)));
  return bsdfs;
}

/// The scene's punctual lights, and the suns of its sky.
static std::vector<PunctualLight> lights_and_suns(const Scene& scene) {
  std::vector<PunctualLight> lights = scene.lights;
  if (scene.background.map)
    for (const DistantSun& sun : scene.background.map->suns)
      lights.push_back({.name = scene.background.map->name,
                        .kind = PunctualKind::directional,
                        .intensity = sun.irradiance,
                        .direction = -sun.towards});
  return lights;
}

/// The openings to the sky as emitters, of its radiance in the mean over the outside of each.
static void add_portals(LightScene& light) {
  light.portals = find_sky_portals(light.scene, light.surfaces, light.rays);
  for (std::uint32_t p = 0; p < light.portals.size(); ++p) {
    const SkyPortal& portal = light.portals[p];
    Emitter emitter;
    emitter.corners.assign(portal.polygon.span().begin(), portal.polygon.span().end());
    emitter.plane = portal.plane;
    emitter.plane_class = portal.plane_class;
    emitter.radiosity = light.sky == nullptr
                            ? light.background
                            : Rgb(std::numbers::pi * mean_beyond(*light.sky, -portal.plane.normal));
    emitter.area = portal.area;
    emitter.portal = p;
    light.emitters.push_back(emitter);
  }
}

/// The flat lights that are no faces, as emitters.
static void add_area_lights(LightScene& light) {
  const std::vector<AreaLight>& lights = light.scene.area_lights;
  for (std::uint32_t k = 0; k < lights.size(); ++k) {
    Emitter emitter;
    emitter.corners = lights[k].corners;
    emitter.plane = {lights[k].axis, glm::dot(lights[k].axis, lights[k].corners[0])};
    emitter.radiosity = std::numbers::pi * lights[k].radiance;
    emitter.area = area_of(lights[k]);
    emitter.area_light = k;
    if (emitter.radiosity != Rgb(0.0))
      light.emitters.push_back(emitter);
  }
}

/// Adds those that are no faces: area lights, then the openings to the sky where it is theirs.
static void add_faceless_emitters(LightScene& light, bool portals) {
  add_area_lights(light);
  if (portals)
    add_portals(light);
  light.side_of_emitter.resize(light.emitters.size(), none<SideId>);
  light.emitter_tree = make_emitter_tree(light.emitters);
}

LightScene make_light_scene(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                            const MirrorsAndWorlds& reflected, const ElementMesh& mesh,
                            const DecodedTextures& textures) {
  const auto& [mirrors, worlds] = reflected;
  const RayFrame& frame = rays.frame();
  LightScene light{scene,
                   surfaces,
                   rays,
                   mirrors,
                   worlds,
                   mesh,
                   textures,
                   make_element_lookup(scene, surfaces, mirrors, mesh, frame.centre, frame.scale),
                   {},
                   {},
                   {},
                   {},
                   lights_and_suns(scene),
                   std::numbers::pi * scene.background.constant,
                   scene.background.map.get(),
                   reflecting_by_angle(scene),
                   std::ranges::any_of(scene.materials, is_glass),
                   cut_out_mirrors(surfaces, rays, mirrors),
                   find_solid_bodies(scene, frame),
                   is_finely_tessellated(mesh),
                   {}};
  light.direct_sides.assign(mesh.sides.size(), 0);

  double area = 0.0, emitting_area = 0.0;
  for (const auto& side : mesh.sides) {
    const double side_area = surfaces.patches[index(side.patch)].area;
    area += side_area;
    if (emits(side))
      emitting_area += side_area;
  }
  if (emitting_area > large_emitter_share * area) {
    add_faceless_emitters(light, false);
    return light;
  }

  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    if (!emits(mesh.sides[s]))
      continue;
    light.direct_sides[s] = 1;
    add_emitters(surfaces, mesh, mesh.sides[s], light.emitters);
    light.side_of_emitter.resize(light.emitters.size(), static_cast<SideId>(s));
  }
  add_faceless_emitters(light, true);
  return light;
}

void tell_lamps_apart(LightScene& light, std::shared_ptr<const LampGroups> groups) {
  LampShares& lamps = light.lamps;
  lamps = {};
  lamps.count = groups->size();
  lamps.sky = groups->sky == no_lamp ? 0 : groups->sky;
  for (const MeshSide& side : light.mesh.sides)
    lamps.of_side.push_back(emits(side) ? lamp_of(*groups, side.node, side.material) : no_lamp);
  for (std::size_t k = 0; k < light.emitters.size(); ++k) {
    const SideId side = light.side_of_emitter[k];
    const Emitter& emitter = light.emitters[k];
    lamps.of_emitter.push_back(side != none<SideId> ? lamps.of_side[index(side)]
                               : emitter.shows_sky() ? lamps.sky
                                                     : groups->of_area_light[emitter.area_light]);
  }
  lamps.of_punctual = groups->of_light;
  lamps.of_punctual.resize(light.punctual.size(), groups->sun);
  light.lamp_groups = std::move(groups);
}

std::shared_ptr<const LightScene> light_scene_on(const std::shared_ptr<const LightScene>& light,
                                                 ElementMesh mesh) {
  struct OnMesh {
    std::shared_ptr<const LightScene> of; // whose scene and rays it shares
    ElementMesh mesh;
    LightScene light; // refers to the mesh beside it
    OnMesh(std::shared_ptr<const LightScene> shared, const LightScene& from, ElementMesh own)
        : of(std::move(shared)), mesh(std::move(own)),
          light(make_light_scene(from.scene, from.surfaces, from.rays, {from.mirrors, from.worlds},
                                 mesh, from.textures)) {
      if (from.lamp_groups)
        tell_lamps_apart(light, from.lamp_groups);
    }
  };
  average_textures(light->scene, light->surfaces, light->textures, mesh);
  const auto both = std::make_shared<const OnMesh>(light, *light, std::move(mesh));
  return {both, &both->light};
}

} // namespace meninas
