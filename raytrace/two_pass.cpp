#include "raytrace/two_pass.h"

#include "radiosity/light/spot_parts.h"
#include "radiosity/mesh/make_mesh.h"
#include "radiosity/scene/surface_colour.h"
#include "raytrace/scene_textures.h"
#include "raytrace/views/seen_elements.h"
#include "scenes/rays/mixed_scales.h"
#include "scenes/repair/retriangulation.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/surfaces/patches.h"
#include "scenes/surfaces/plane_classes.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <iterator>

namespace meninas {

std::shared_ptr<const PreparedScene> prepare_scene(Scene scene, const PassOneSettings& settings) {
  const auto prepared = std::make_shared<PreparedScene>();
  prepared->scene = std::move(scene);
  Stopwatch watch;

  // A texture of one colour becomes a factor before anything is decided by factors.
  std::vector<std::string> warnings;
  prepared->textures = settle_textures(prepared->scene, warnings);

  // The plan: the contents of the scene, and the transport it needs; stages it does not need are not run.
  // Where no mirror is followed, the light that coats reflect is not lost.
  if (settings.form_factors.method == FormFactorMethod::analytic ||
      settings.form_factors.max_bounces == 0)
    spread_coats(prepared->scene);
  prepared->surfaces = find_patches(prepared->scene);
  if (retriangulate_slivers(prepared->scene, prepared->surfaces))
    prepared->surfaces = find_patches(prepared->scene);
  find_plane_classes(prepared->scene, prepared->surfaces);
  prepared->plan = plan_transport(prepared->scene, prepared->surfaces, settings.plan);
  std::ranges::move(warnings, std::back_inserter(prepared->plan.warnings));
  prepared->seconds.plan = watch.lap();

  // Elements to light, and rays over the input geometry, not over the elements.
  prepared->rays.emplace(make_ray_scene(prepared->scene, prepared->surfaces,
                                        holes_of(prepared->scene, prepared->textures)));
  std::ranges::move(warnings_of_mixed_scales(prepared->scene, prepared->surfaces, *prepared->rays),
                    std::back_inserter(prepared->plan.warnings));
  const DarkSides dark = find_dark_sides(prepared->scene, prepared->surfaces, *prepared->rays);
  prepared->mesh = divide_under_spots(
      make_element_mesh(prepared->scene, prepared->surfaces, settings.mesh, dark), prepared->scene,
      prepared->surfaces, prepared->plan.worlds, settings.mesh.max_elements);
  average_textures(prepared->scene, prepared->surfaces, prepared->textures, prepared->mesh);
  prepared->lit.emplace(make_light_scene(
      prepared->scene, prepared->surfaces, *prepared->rays,
      {prepared->plan.mirrors, prepared->plan.worlds}, prepared->mesh, prepared->textures));
  if (settings.lamps)
    tell_lamps_apart(*prepared->lit, std::make_shared<const LampGroups>(
                                         find_lamps(prepared->scene, *settings.lamps)));
  prepared->seconds.mesh = watch.lap();
  return prepared;
}

bool solves_for_view(const PreparedScene& prepared, const TwoPassSettings& settings) {
  // Light that is gathered at hits comes from everywhere.
  constexpr std::size_t min_patches = 8192;
  return settings.pass_one.cut == MeshCut::hierarchical &&
         prepared.surfaces.patches.size() > min_patches &&
         settings.render.diffuse.term != DiffuseTerm::gather;
}

RadiositySolution solve_for_picture(const PreparedScene& prepared, const Camera& camera,
                                    const TwoPassSettings& settings, const Progress& progress,
                                    const PassOneWatch& watch) {
  const SeenElements seen =
      solves_for_view(prepared, settings) ? seen_elements(*prepared.light(), camera, settings.render) : SeenElements{};
  PassOneSettings pass_one = settings.pass_one;
  pass_one.interpolation.mirrored = settings.render.layers == WithLayers::yes;
  return solve_for_view(prepared.light(), pass_one, seen, progress, watch);
}

TwoPassResult two_pass(const PreparedScene& prepared, const Camera& camera,
                       const TwoPassSettings& settings, const Progress& progress,
                       const PassOneWatch& watch) {
  // Pass one:
  // diffuse radiosity, with the light that arrives directly and through every mirror world.
  auto solution = solve_for_picture(prepared, camera, settings, progress, watch);

  // Pass two: specular light, followed from the eye until it lands on the diffuse field.
  auto rendering = render(solution.field, camera, settings.render, progress);
  return {std::move(solution), std::move(rendering)};
}

} // namespace meninas
