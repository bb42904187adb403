#include "runs/trade/trade_run.h"

#include "image/metrics/relative_error.h"
#include "image/whole_file.h"
#include "radiosity/scene/mirror_depth_bound.h"
#include "radiosity/scene/small_elements.h"
#include "raytrace/error/probes.h"
#include "runs/report/comparison.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/reference_run.h"
#include "runs/resources.h"
#include "runs/trade/trade_report.h"
#include "runs/trade/trade_sweep.h"
#include "scenes/errors.h"
#include "scenes/sampling.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>

namespace meninas {
namespace {

namespace fs = std::filesystem;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::optional<Image> layer_of(const ImageFile& file, std::string_view name) {
  for (const Layer& layer : file.layers)
    if (layer.name == name)
      return layer.image;
  return std::nullopt;
}

/// The reference out of its file, with its variance where it has one.
TradeReference read_reference(const fs::path& file, const std::optional<PictureSize>& size) {
  ComparedPicture read = read_compared(file, std::nullopt);
  if (read.encoding != Encoding::linear)
    throw InputError(file.string(), "",
                     "holds displayed colours: a reference needs radiances, as an EXR");
  if (size && (size->width != read.image.width || size->height != read.image.height))
    throw InputError(file.string(), "",
                     fmt::format("is {}x{}, not {}x{}", read.image.width, read.image.height,
                                 size->width, size->height));
  TradeReference reference;
  reference.kind = "file";
  reference.name = file.filename().string();
  reference.variance = layer_of(read_image(file), "variance");
  reference.mean = std::move(read.image);
  return reference;
}

/// By path tracing, for a share of the budget:
/// it shares nothing with what it judges, and its noise is known.
TradeReference trace_reference(const Scene& scene, const Camera& camera, PictureSize size,
                               double seconds, std::uint32_t seed, const RunEvents& events) {
  reference::ReferenceSettings limits;
  limits.width = size.width;
  limits.height = size.height;
  limits.max_error = 0.0;
  limits.max_seconds = seconds;
  limits.seed = seed;
  RunFigures figures;
  auto picture = run_reference(scene, camera, limits, events, figures);
  TradeReference reference;
  reference.kind = "path tracer";
  reference.name = fmt::format("{} samples a pixel", picture.samples);
  reference.seconds = figures.seconds.render;
  reference.mean = std::move(picture.mean);
  reference.variance = std::move(picture.variance);
  return reference;
}

/// The root mean square of the noise over the mean, and the least error that can be told from it:
/// a mean of n squares of noise is unsure by their variance times the root of 2 / n.
void find_floor(TradeReference& reference) {
  if (!reference.variance)
    return;
  double noise = 0.0, mean = 0.0;
  const auto count = static_cast<double>(3 * reference.mean.pixels.size());
  for (std::size_t p = 0; p < reference.mean.pixels.size(); ++p)
    for (int band = 0; band < 3; ++band) {
      noise += double{reference.variance->pixels[p][band]} / count;
      mean += double{reference.mean.pixels[p][band]} / count;
    }
  if (!(mean > 0.0))
    return;
  reference.noise = std::sqrt(noise) / mean;
  // Channels share their noise: a pixel counts once.
  reference.floor = reference.noise * std::pow(2.0 / (count / 3.0), 0.25);
}

/// What all points are measured on.
struct Measuring {
  const Scene& scene;
  const Camera& camera;
  const TradeReference& reference;
  std::vector<std::uint8_t> emits = {}; ///< found with the first point
};

void measure_point(Measuring& measuring, TradePoint& point) {
  const bool first = point.seconds.empty();
  RunSettings settings = point.settings;
  settings.seed =
      first ? settings.seed : hash(settings.seed, static_cast<std::uint32_t>(point.seconds.size()));
  TwoPassSettings two_pass = two_pass_settings(settings);
  two_pass.render.width = measuring.reference.mean.width;
  two_pass.render.height = measuring.reference.mean.height;
  Stopwatch watch;
  const double before = processor_seconds();
  const auto prepared = prepare_scene(measuring.scene, two_pass.pass_one);
  TwoPassResult result = meninas::two_pass(*prepared, measuring.camera, two_pass);
  point.processor_seconds.push_back(processor_seconds() - before);
  point.seconds.push_back(watch.lap());

  if (measuring.emits.empty()) {
    constexpr int samples = 16;
    measuring.emits = emitter_pixels(result.solution.field, measuring.camera, two_pass.render,
                                     measuring.reference.mean, samples);
  }
  const auto& variance = measuring.reference.variance;
  point.errors.push_back(relative_error(result.rendering.image, measuring.reference.mean,
                                        measuring.emits, variance ? &*variance : nullptr));
  if (!first)
    return;
  RunFigures figures;
  add_preparation(figures, *prepared);
  add_solution(figures, result.solution);
  point.stages = figures.seconds;
  point.stages.render = point.seconds.front() - figures.seconds.plan - figures.seconds.mesh -
                        figures.seconds.form_factors - figures.seconds.solve -
                        figures.seconds.interpolate;
  point.elements = figures.elements;
  point.estimate = estimate_error(result.solution.field, measuring.camera, two_pass, result.solution.solver,
      {result.rendering.image, result.rendering.samples, result.rendering.finer.get()}, error_settings(two_pass, sampled_elements(*result.solution.field.scene)));
  point.picture = std::move(result.rendering.image);
}

PictureSize size_of(const TradeRequest& request, const Camera& camera) {
  if (request.size)
    return *request.size;
  constexpr int rows = 256;
  PictureSize size = choose_size(std::nullopt, camera);
  size.width = std::max(1, size.width * rows / size.height);
  size.height = rows;
  return size;
}

/// Warnings of the scene, and what a sweep has to know about it.
TradeScene look_at_scene(const Scene& scene, const RunEvents& events) {
  const SurfaceModel surfaces = find_surfaces(scene);
  const TransportPlan plan = plan_transport(scene, surfaces, PlanSettings{});
  for (const std::string& warning : plan.warnings)
    warn(events, warning);
  if (!(receiving_area(scene, surfaces) > 0.0))
    throw InputError(scene.file, "", "has no surface that light could be found on");
  return {!plan.mirror_list.empty()};
}

} // namespace

void trade_run(const TradeRequest& request, const RunEvents& events) {
  constexpr double for_reference = 0.3; // of the budget
  const auto begin = std::chrono::steady_clock::now();
  const auto spent = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  make_folder(request.folder);
  for (const char* file : {"trade.json", "trade.csv", "index.html"})
    check_writable_file(request.folder / file);
  const ThreadLimit limit(request.settings.threads);
  const Scene scene = load_scene(request.scene, request.settings);
  const Camera chosen = choose_camera(scene, request.camera, request.settings, events);
  const TradeScene facts = look_at_scene(scene, events);

  TradeResult result;
  std::optional<TradeReference> known;
  if (request.reference)
    known = read_reference(*request.reference, request.size);
  const PictureSize size = known ? PictureSize{known->mean.width, known->mean.height}
                                 : size_of(request, chosen);
  const Camera camera = cut_open(scene, chosen, size, events);
  result.reference =
      known ? std::move(*known)
            : trace_reference(scene, camera, size, for_reference * request.budget,
                            request.settings.seed, {.warning = {}, .note = events.note, .progress = events.progress, .stages = {}});
  find_floor(result.reference);
  Measuring measuring{scene, camera, result.reference};
  const MeasurePoint measure = [&](TradePoint& point) { measure_point(measuring, point); };
  const auto tell = [&](const std::string& stage, double fraction) {
    if (events.progress)
      events.progress(stage, fraction);
  };
  result.points = sweep(request.settings, facts, measure, {request.budget, spent, tell});
  result.scene = request.scene;
  result.camera = request.camera;
  result.budget = request.budget;
  result.spent = spent();
  result.threads = limit.threads();
  write_text_file(request.folder / "trade.json", trade_json(result));
  write_text_file(request.folder / "trade.csv", trade_csv(result));
  write_text_file(request.folder / "index.html", trade_page_of(result));
  note(events, fmt::format("{} settings measured; open {}", result.points.size(),
                           (request.folder / "index.html").string()));
}

} // namespace meninas
