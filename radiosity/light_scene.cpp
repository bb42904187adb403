#include "radiosity/light_scene.h"

#include <algorithm>

namespace meninas {

namespace {

constexpr double large_emitter_share = 0.5;

bool emits(const MeshSide& side) { return glm::any(glm::greaterThan(side.emission, Rgb(0.0))); }

Emitter make_emitter(const SurfaceModel& surfaces, const MeshSide& side) {
  const Patch& patch = surfaces.patches[index(side.patch)];
  Emitter emitter;
  emitter.polygon = ConvexPolygon(polygon_of(patch));
  if (side.facing == Facing::back)
    std::reverse(emitter.polygon.vertices.begin(),
                 emitter.polygon.vertices.begin() +
                     static_cast<std::ptrdiff_t>(emitter.polygon.size));
  emitter.plane = side.plane;
  emitter.plane_class = side.plane_class;
  emitter.radiosity = side.emission;
  emitter.area = patch.area;
  return emitter;
}

} // namespace

bool grey_mirrors(const Scene& scene) {
  return std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    const Rgb r = mirror_reflectance(material);
    return r.r == r.g && r.g == r.b;
  });
}

LightScene make_light_scene(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                            const MirrorSet& mirrors, const WorldTree& worlds,
                            const ElementMesh& mesh) {
  const RayFrame& frame = rays.frame();
  LightScene light{scene,
                   surfaces,
                   rays,
                   mirrors,
                   worlds,
                   mesh,
                   make_landing_table(scene, surfaces, mirrors, mesh, frame.centre, frame.scale),
                   {},
                   {},
                   {}};
  light.from_source.assign(mesh.sides.size(), 0);

  double area = 0.0, emitting_area = 0.0;
  for (const auto& side : mesh.sides) {
    const double side_area = surfaces.patches[index(side.patch)].area;
    area += side_area;
    if (emits(side))
      emitting_area += side_area;
  }
  if (emitting_area > large_emitter_share * area)
    return light;

  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    if (!emits(mesh.sides[s]))
      continue;
    light.from_source[s] = 1;
    light.emitters.push_back(make_emitter(surfaces, mesh.sides[s]));
  }
  light.emitter_tree = make_emitter_tree(light.emitters);
  return light;
}

std::unique_ptr<RefinedScene> make_refined_scene(const LightScene& light, ElementMesh mesh) {
  auto refined = std::make_unique<RefinedScene>();
  refined->mesh = std::move(mesh);
  refined->light.emplace(make_light_scene(light.scene, light.surfaces, light.rays, light.mirrors,
                                          light.worlds, refined->mesh));
  return refined;
}

} // namespace meninas
