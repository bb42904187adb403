#include "runs/render_run.h"

#include "radiosity/solution_file.h"
#include "runs/preparation.h"
#include "runs/resources.h"
#include "scenes/gltf.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

namespace meninas {
namespace {

void check_files(const RenderRequest& request) {
  OutputFiles outputs{.pictures = request.pictures, .solution = {}, .texts = {}};
  std::vector<std::filesystem::path> inputs{request.scene};
  if (request.stats) {
    outputs.texts.push_back(*request.stats);
  }
  if (request.solution) {
    inputs.push_back(*request.solution);
  }
  check_outputs(outputs, inputs);
}

/// What makes a picture what it is; the same for the same bits, whether pass one was run or read.
Attributes attributes_of(const Scene& scene, const Camera& camera, const RenderSettings& render) {
  return {{"scene", std::filesystem::path(scene.file).filename().string()},
          {"sceneHash", fmt::format("{:016x}", content_hash(scene))},
          {"camera", camera.name},
          {"mode", render.mode == RenderMode::hybrid ? "hybrid" : "radiosity"},
          {"samples", std::to_string(render.samples)},
          {"seed", std::to_string(render.seed)}};
}

/// Both passes, timed.
Image run_two_pass(const PreparedScene& prepared, const Camera& camera,
                   const TwoPassSettings& settings, const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  TwoPassResult result = two_pass(prepared, camera, settings, events.progress);
  add_solution(figures, result.solution);
  add_rendering(figures, result.rendering);
  const PassOneSeconds& pass_one = result.solution.seconds;
  figures.seconds.render =
      watch.lap() - pass_one.form_factors - pass_one.solve - pass_one.interpolate;
  return std::move(result.rendering.image);
}

/// Pass two over the field of an earlier pass one, whose figures are repeated.
Image run_pass_two(const PreparedScene& prepared, StoredSolution stored, const Camera& camera,
                   const TwoPassSettings& settings, const RunEvents& events, RunFigures& figures) {
  Stopwatch watch;
  figures.solver = std::move(stored.solver);
  figures.energy = stored.energy;
  figures.closure = stored.closure;
  Rendering rendering =
      render(*prepared.light, stored.field, camera, settings.render, events.progress);
  add_rendering(figures, rendering);
  figures.seconds.render = watch.lap();
  return std::move(rendering.image);
}

} // namespace

RunFigures render_run(const RenderRequest& request, const RunEvents& events) {
  check_files(request);
  const ThreadLimit limit(request.settings.threads);
  TwoPassSettings settings = two_pass_settings(request.settings);
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total;
  Stopwatch watch;

  Scene scene = load_gltf(request.scene);
  const Camera camera = choose_camera(scene, request.camera, events);
  std::optional<StoredSolution> stored;
  if (request.solution) {
    stored = read_solution(*request.solution, scene);
    settings.pass_one.mesh = stored->mesh;
  }
  preload_image_io();
  figures.seconds.load = watch.lap();

  const auto prepared = prepare_run(std::move(scene), settings.pass_one, events, figures);
  if (stored) {
    check_belongs(*request.solution, *stored, prepared->mesh);
  }
  const PictureSize size = choose_size(request.size, camera);
  settings.render.width = size.width;
  settings.render.height = size.height;
  const Image picture =
      stored ? run_pass_two(*prepared, std::move(*stored), camera, settings, events, figures)
             : run_two_pass(*prepared, camera, settings, events, figures);
  warn_of_solution(figures.solver, figures.closure, events);

  watch.lap();
  write_pictures(request.pictures, picture, request.picture,
                 attributes_of(prepared->scene, camera, settings.render), events);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  if (request.stats) {
    write_text_file(*request.stats, stats_json(figures));
  }
  return figures;
}

} // namespace meninas
