#include "runs/view.h"

#include "radiosity/solution_file.h"
#include "runs/preparation.h"
#include "runs/reference_run.h"
#include "scenes/content_hash.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

namespace meninas {

namespace fs = std::filesystem;

static Attributes attributes_of(const Scene& scene, const Camera& camera,
                                const RunSettings& settings) {
  return {{"scene", fs::path(scene.file).filename().string()},
          {"sceneHash", hex_digits(content_hash(scene))},
          {"camera", camera.name},
          {"seed", std::to_string(settings.seed)}};
}

LitScene solve_lit_scene(Scene scene, const PassOneSettings& settings,
                         const std::optional<fs::path>& kept, const RunEvents& events,
                         RunFigures& figures) {
  LitScene lit{.prepared = prepare_run(std::move(scene), settings, events, figures),
               .field = {},
               .refined = {}};
  RadiositySolution solution = solve_pass_one(*lit.prepared->light, settings, events.progress);
  add_solution(figures, solution);
  warn_of_solution(figures.solver, figures.closure, events);
  if (kept) {
    write_solution(*kept, lit.prepared->scene, lit.prepared->mesh, solution, settings.mesh);
  }
  lit.field = std::move(solution.field);
  lit.refined = std::move(solution.refined);
  return lit;
}

LitScene read_lit_scene(const fs::path& file, Scene scene, PassOneSettings settings,
                        const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  StoredSolution stored = read_solution(file, scene);
  settings.mesh = stored.mesh;
  figures.seconds.load += watch.lap();
  LitScene lit{.prepared = prepare_run(std::move(scene), settings, events, figures),
               .field = {},
               .refined = {}};
  lit.refined = refined_scene_of(file, stored, *lit.prepared->light);
  check_belongs(file, stored, lit.light().mesh);
  if (lit.refined) {
    figures.elements = element_count(lit.refined->mesh);
    figures.vertices = lit.refined->mesh.vertices.size();
  }
  figures.solver = std::move(stored.solver);
  figures.energy = stored.energy;
  figures.closure = stored.closure;
  warn_of_solution(figures.solver, figures.closure, events);
  lit.field = std::move(stored.field);
  return lit;
}

ViewPicture picture_of(const Scene& scene, const Camera& camera, const RunSettings& settings,
                       Rendering rendering) {
  const RenderSettings used = two_pass_settings(settings).render;
  ViewPicture picture{.image = std::move(rendering.image),
                      .layers = std::move(rendering.layers),
                      .attributes = attributes_of(scene, camera, settings)};
  picture.attributes.emplace_back("mode", used.mode == RenderMode::hybrid ? "hybrid" : "radiosity");
  picture.attributes.emplace_back("samples", std::to_string(used.samples));
  return picture;
}

ViewPicture render_view(const LitScene& lit, const Camera& camera, PictureSize size,
                        const RunSettings& settings, const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  RenderSettings used = two_pass_settings(settings).render;
  used.width = size.width;
  used.height = size.height;
  Rendering rendering = render(lit.light(), lit.field, camera, used, events.progress);
  add_rendering(figures, rendering);
  figures.seconds.render = watch.lap();
  return picture_of(lit.prepared->scene, camera, settings, std::move(rendering));
}

ViewPicture render_reference_view(Scene scene, const Camera& camera, PictureSize size,
                                  const RunSettings& settings, const RunEvents& events,
                                  RunFigures& figures) {
  ViewPicture result{
      .image = {}, .layers = {}, .attributes = attributes_of(scene, camera, settings)};
  reference::ReferenceSettings limits = reference_settings(settings);
  limits.width = size.width;
  limits.height = size.height;
  auto picture = run_reference(std::move(scene), camera, limits, events, figures);
  result.image = std::move(picture.mean);
  result.layers = std::move(picture.layers);
  result.layers.push_back({"variance", std::move(picture.variance)});
  result.attributes.emplace_back("mode", "reference");
  result.attributes.emplace_back("samples", std::to_string(picture.samples));
  result.attributes.emplace_back("standardError", fmt::format("{:.4g}", picture.standard_error));
  return result;
}

} // namespace meninas
