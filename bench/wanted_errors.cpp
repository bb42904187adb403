// Whether runs that choose their own settings (runs/steering/steering.h) get where they were asked to.
//
//   wanted_errors X REFERENCES SCENE.gltf ...
//
// Every scene is rendered for the relative error X, in the size of REFERENCES/NAME.reference.exr,
// whose variance is taken off. Its true error stands beside the estimate that the run ended with,
// with the steps and the processor seconds it took.
#include "bench/truth.h"
#include "image/metrics/relative_error.h"
#include "raytrace/error/probes.h"
#include "runs/steering/setting_options.h"
#include "runs/steering/steering.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <string>

using namespace meninas;
using namespace meninas::bench;

namespace {

/// What shows lamps, as the truth shows it.
std::vector<std::uint8_t> emitters_in(const Scene& scene, const Camera& camera,
                                      const Image& truth) {
  RunSettings coarse;
  coarse.quality = Quality::draft;
  coarse.rays = 16;
  TwoPassSettings settings = two_pass_settings(coarse);
  settings.render.width = truth.width;
  settings.render.height = truth.height;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light, settings.pass_one);
  constexpr int samples = 16;
  return emitter_pixels(solution.field, camera, settings.render, truth, samples);
}

double measure_scene(double wanted, const std::filesystem::path& references,
                     const std::filesystem::path& file) {
  const Truth truth = read_truth(references, file);
  const Scene& scene = truth.scene;
  const Camera camera =
      scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  const auto emits = emitters_in(scene, camera, truth.mean);

  RunFigures figures;
  const std::clock_t before = std::clock();
  const ViewPicture view = steer({scene,
                                  camera,
                                  {truth.mean.width, truth.mean.height},
                                  {},
                                  {.error = wanted, .seconds = {}},
                                  0.0,
                                  0.0},
                                 {}, figures);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const double error =
      relative_error(view.image, truth.mean, emits, truth.variance ? &*truth.variance : nullptr);
  // Where the noise of the reference is several times the error,
  // its variance is not known well enough to take it off.
  const double with_noise = relative_error(view.image, truth.mean, emits, nullptr);
  const double noise = std::sqrt(std::max(with_noise * with_noise - error * error, 0.0));
  const SteeredChoice& choice = *figures.choice;
  fmt::print(
      "{:15} error {:.4f} (reference's noise {:.4f}) estimate {:.4f} {} {} steps {:6.2f} s  {}\n",
      file.stem().string(), error, noise, figures.error_estimate->total,
      choice.reached ? "reached" : "not reached", choice.steps.size(), seconds,
      fmt::join(choice.options, " "));
  std::fflush(stdout);
  return error;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print("wanted_errors X REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    const double wanted = std::stod(argv[1]);
    int below = 0, near = 0;
    for (int k = 3; k < argc; ++k) {
      const double error = measure_scene(wanted, argv[2], argv[k]);
      below += error <= wanted ? 1 : 0;
      near += error <= 1.5 * wanted ? 1 : 0;
    }
    fmt::print("of {} scenes {} within the error, {} within 1.5 times\n", argc - 3, below, near);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
