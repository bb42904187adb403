#include "runs/render_run.h"

#include "radiosity/solution_file.h"
#include "runs/preparation.h"
#include "runs/reference_run.h"
#include "runs/resources.h"
#include "scenes/errors.h"
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

/// A picture and what it is: the same bits belong to the same attributes, whether pass one was run or read.
struct Rendered {
  Image image;
  std::vector<Layer> layers;
  Attributes attributes;
};

Attributes common_attributes(const Scene& scene, const Camera& camera,
                             const RunSettings& settings) {
  return {{"scene", std::filesystem::path(scene.file).filename().string()},
          {"sceneHash", fmt::format("{:016x}", content_hash(scene))},
          {"camera", camera.name},
          {"seed", std::to_string(settings.seed)}};
}

/// Both passes, timed.
Rendering run_two_pass(const PreparedScene& prepared, const Camera& camera,
                       const TwoPassSettings& settings, const RunEvents& events,
                       RunFigures& figures) {
  Stopwatch watch;
  TwoPassResult result = two_pass(prepared, camera, settings, events.progress);
  add_solution(figures, result.solution);
  add_rendering(figures, result.rendering);
  const PassOneSeconds& pass_one = result.solution.seconds;
  figures.seconds.render =
      watch.lap() - pass_one.form_factors - pass_one.solve - pass_one.interpolate;
  return std::move(result.rendering);
}

/// Pass two over the field of an earlier pass one, whose figures are repeated.
Rendering run_pass_two(const PreparedScene& prepared, StoredSolution stored, const Camera& camera,
                       const TwoPassSettings& settings, const RunEvents& events,
                       RunFigures& figures) {
  Stopwatch watch;
  figures.solver = std::move(stored.solver);
  figures.energy = stored.energy;
  figures.closure = stored.closure;
  Rendering rendering =
      render(*prepared.light, stored.field, camera, settings.render, events.progress);
  add_rendering(figures, rendering);
  figures.seconds.render = watch.lap();
  return rendering;
}

Rendered render_two_pass(const RenderRequest& request, Scene scene, const Camera& camera,
                         PictureSize size, const RunEvents& events, RunFigures& figures) {
  TwoPassSettings settings = two_pass_settings(request.settings);
  settings.render.width = size.width;
  settings.render.height = size.height;
  std::optional<StoredSolution> stored;
  if (request.solution) {
    Stopwatch watch;
    stored = read_solution(*request.solution, scene);
    settings.pass_one.mesh = stored->mesh;
    figures.seconds.load += watch.lap();
  }
  const auto prepared = prepare_run(std::move(scene), settings.pass_one, events, figures);
  if (stored) {
    check_belongs(*request.solution, *stored, prepared->mesh);
    if (settings.render.layers == WithLayers::yes && stored->field.mirrored.empty()) {
      throw InputError(request.solution->string(), "",
                       "does not know what mirrors brought: solve again with --interpolation "
                       "gather");
    }
  }
  Rendering rendering =
      stored ? run_pass_two(*prepared, std::move(*stored), camera, settings, events, figures)
             : run_two_pass(*prepared, camera, settings, events, figures);
  warn_of_solution(figures.solver, figures.closure, events);
  Rendered rendered;
  rendered.image = std::move(rendering.image);
  rendered.layers = std::move(rendering.layers);
  rendered.attributes = {
      {"mode", settings.render.mode == RenderMode::hybrid ? "hybrid" : "radiosity"},
      {"samples", std::to_string(settings.render.samples)}};
  return rendered;
}

Rendered render_reference(const RenderRequest& request, Scene scene, const Camera& camera,
                          PictureSize size, const RunEvents& events, RunFigures& figures) {
  reference::ReferenceSettings settings = reference_settings(request.settings);
  settings.width = size.width;
  settings.height = size.height;
  auto picture = run_reference(std::move(scene), camera, settings, events, figures);
  Rendered rendered;
  rendered.image = std::move(picture.mean);
  rendered.layers = std::move(picture.layers);
  rendered.layers.push_back({"variance", std::move(picture.variance)});
  rendered.attributes = {{"mode", "reference"},
                         {"samples", std::to_string(picture.samples)},
                         {"standardError", fmt::format("{:.4g}", picture.standard_error)}};
  return rendered;
}

} // namespace

RunFigures render_run(const RenderRequest& request, const RunEvents& events) {
  check_files(request);
  const ThreadLimit limit(request.settings.threads);
  RunFigures figures;
  figures.threads = limit.threads();
  Stopwatch total;
  Stopwatch watch;

  Scene scene = load_gltf(request.scene);
  const Camera camera = choose_camera(scene, request.camera, events);
  const PictureSize size = choose_size(request.size, camera);
  Attributes attributes = common_attributes(scene, camera, request.settings);
  preload_image_io();
  figures.seconds.load = watch.lap();

  const auto render_mode =
      request.settings.mode == PictureMode::reference ? render_reference : render_two_pass;
  const Rendered rendered = render_mode(request, std::move(scene), camera, size, events, figures);

  watch.lap();
  attributes.insert(attributes.end(), rendered.attributes.begin(), rendered.attributes.end());
  write_pictures(request.pictures, rendered.image, rendered.layers, request.picture, attributes,
                 events);
  figures.seconds.write = watch.lap();
  figures.seconds.total = total.lap();
  figures.peak_memory_bytes = peak_memory_bytes();
  if (request.stats) {
    write_text_file(*request.stats, stats_json(figures));
  }
  return figures;
}

} // namespace meninas
