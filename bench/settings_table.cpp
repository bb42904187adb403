// What settings bring in each scene: time, error and FLIP, beside the path tracer at equal time.
//
//   settings_table [--settings draft,normal,fine,0.02,0.01] [--without-paths] REFERENCES SCENE.gltf ...
//
// A name is a quality, a number an error that is wanted (runs/steering/steering.h), whose steps are told to the
// standard error. Pictures have the size of
// REFERENCES/NAME.reference.exr. Printed, as rows of a table:
//
//   seconds    processor time of all threads, from the scene in memory to the picture with its estimate
//   wasted     the share of it that went into steps whose picture was not kept
//   error      relative, outside emitters, the variance of the reference taken off (image/metrics/relative_error.h)
//   estimate   what the run says of it
//   FLIP       mean and 99th percentile over the pixels, at the automatic exposure of the reference, whose noise is in it
//   paths      the path tracer's processor time, error and FLIP with as many samples as take as long, at least 32
#include "bench/truth.h"
#include "image/display.h"
#include "image/metrics/metrics.h"
#include "image/metrics/relative_error.h"
#include "radiosity/scene/small_elements.h"
#include "raytrace/error/probes.h"
#include "runs/reference_run.h"
#include "runs/steering/setting_options.h"
#include "runs/steering/steering.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

using namespace meninas;
using namespace meninas::bench;

namespace {

struct KnownScene {
  Truth truth;
  Camera camera;
  std::vector<std::uint8_t> emits; ///< by pixel: 1 shows a lamp
  double exposure = 0.0;           ///< stops, of FLIP

  const Scene& scene() const { return truth.scene; }
  PictureSize size() const { return {truth.mean.width, truth.mean.height}; }
};

KnownScene known_scene(const std::filesystem::path& references, const std::filesystem::path& file) {
  KnownScene known{.truth = read_truth(references, file), .camera = {}, .emits = {}};
  const Scene& scene = known.scene();
  known.camera = scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  known.exposure = automatic_exposure(known.truth.mean);
  RunSettings coarse;
  coarse.quality = Quality::draft;
  coarse.rays = 16;
  const RenderSettings render = render_settings(coarse, known.size());
  const TwoPassSettings settings = two_pass_settings(coarse);
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
  constexpr int samples = 16;
  known.emits = emitter_pixels(solution.field, known.camera, render, known.truth.mean, samples);
  return known;
}

struct Made {
  Image image;
  double seconds = 0.0, wasted = 0.0, estimate = 0.0;
  std::size_t steps = 1;
  std::string options;
};

/// As `render --quality` makes it.
Made by_quality(const KnownScene& known, Quality quality) {
  RunSettings run;
  run.quality = quality;
  TwoPassSettings settings = two_pass_settings(run);
  settings.render = render_settings(run, known.size());
  const double before = processor_seconds();
  const auto prepared = prepare_scene(known.scene(), settings.pass_one);
  const RadiositySolution solution = solve_for_picture(*prepared, known.camera, settings);
  Rendering shown = render(solution.field, known.camera, settings.render);
  const PictureError error =
      estimate_error(solution.field, known.camera, settings, solution.solver,
                     {shown.image, shown.samples, shown.finer.get()},
                     error_settings(settings, sampled_elements(*solution.field.scene)));
  return {std::move(shown.image), processor_seconds() - before, 0.0, error.total, 1, {}};
}

/// As `render --error` makes it.
Made by_error(const KnownScene& known, double wanted) {
  RunFigures figures;
  const double before = processor_seconds();
  RunEvents events;
  events.note = [](const std::string& text) { fmt::print(stderr, "{}\n", text); };
  ViewPicture view = steer({known.scene(), known.camera, known.size(), {},
                            {.error = wanted, .seconds = {}}, 0.0, 0.0},
                           events, figures);
  const double seconds = processor_seconds() - before;
  const SteeredChoice& choice = *figures.choice;
  double all = 0.0;
  for (const SteeredStep& step : choice.steps)
    all += step.seconds;
  return {std::move(view.image),
          seconds,
          1.0 - choice.steps[choice.kept].seconds / all,
          figures.error_estimate->total,
          choice.steps.size(),
          fmt::format("{}", fmt::join(choice.options, " "))};
}

double error_of(const KnownScene& known, const Image& image) {
  const Truth& truth = known.truth;
  return relative_error(image, truth.mean, known.emits, truth.variance ? &*truth.variance : nullptr);
}

/// Mean and 99th percentile.
std::string flip_of(const KnownScene& known, const Image& image) {
  const PictureDifference difference =
      compare_pictures(image, known.truth.mean, {.exposure = known.exposure});
  std::vector<float> values = difference.flip_map.values;
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(0.99 * double(values.size()));
  std::ranges::nth_element(values, high);
  return fmt::format("{:.3f}, {:.2f}", difference.flip, *high);
}

/// The path tracer's, with as many samples as take `seconds` of the processor.
std::string by_paths(const KnownScene& known, double seconds) {
  constexpr int fewest = 2 * reference::batch_samples;
  reference::ReferenceSettings settings{.width = known.size().width,
                                        .height = known.size().height,
                                        .max_samples = fewest,
                                        .max_error = 0.0,
                                        .seed = 1}; // the reference's is 0: another noise
  const auto trace = [&](int samples) {
    settings.max_samples = samples;
    RunFigures figures;
    const double before = processor_seconds();
    auto picture = run_reference(known.scene(), known.camera, settings, {}, figures);
    return std::pair(std::move(picture.mean), processor_seconds() - before);
  };
  auto [image, taken] = trace(fewest);
  if (const double times = std::floor(seconds / taken); times >= 2.0)
    std::tie(image, taken) = trace(fewest * static_cast<int>(times));
  // Its noise is another than the reference's, and is not taken off.
  return fmt::format("{:.2f} s, {:.1f} %, {}", taken, 100.0 * error_of(known, image),
                     flip_of(known, image));
}

void measure(const KnownScene& known, const std::string& name, const std::string& settings,
             bool with_paths) {
  const bool wanted = settings.find_first_of("0123456789") != std::string::npos;
  const Made made = wanted                 ? by_error(known, std::stod(settings))
                    : settings == "draft"  ? by_quality(known, Quality::draft)
                    : settings == "normal" ? by_quality(known, Quality::normal)
                                           : by_quality(known, Quality::fine);
  fmt::print("| `{}` | {} | {:.2f} s | {:.1f} % | {:.1f} % | {} |", name,
             wanted ? fmt::format("`--error {}`", settings) : fmt::format("`{}`", settings),
             made.seconds, 100.0 * error_of(known, made.image), 100.0 * made.estimate,
             flip_of(known, made.image));
  fmt::print(" {} | {:.0f} %, {} |", with_paths ? by_paths(known, made.seconds) : "",
             100.0 * made.wasted, made.steps);
  fmt::print(" {}\n", made.options);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  std::vector<std::string> given(argv + 1, argv + argc);
  std::string wanted = "draft,normal,fine,0.02,0.01";
  bool with_paths = true;
  while (!given.empty() && given.front().starts_with("--")) {
    const bool names = given.front() == "--settings" && given.size() > 1;
    if (names)
      wanted = given[1];
    with_paths = with_paths && given.front() != "--without-paths";
    given.erase(given.begin(), given.begin() + (names ? 2 : 1));
  }
  if (given.size() < 2) {
    fmt::print("settings_table [--settings draft,0.02] [--without-paths] REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    fmt::print("| scene | settings | time | error | estimate | FLIP: mean, 99 % | paths: time, error, FLIP | "
               "wasted, steps |\n|---|---|---|---|---|---|---|---|\n");
    for (std::size_t k = 1; k < given.size(); ++k) {
      const std::filesystem::path file = given[k];
      const KnownScene known = known_scene(given[0], file);
      std::istringstream list(wanted);
      for (std::string settings; std::getline(list, settings, ',');)
        measure(known, file.stem().string(), settings, with_paths);
    }
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
