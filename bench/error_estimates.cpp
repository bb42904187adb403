// Whether what a picture says about its own error is true:
// the estimate (raytrace/error/picture_error.h) beside the error against a reference.
//
//   error_estimates REFERENCES SCENE.gltf ...
//
// REFERENCES holds NAME.reference.exr for every scene, of any size:
// of the path tracer (reference/images), whose variance is taken off, or of a run of the two passes
// that is much finer. Every scene is rendered with a coarse and a fine mesh, few and many rays, by
// interpolation and with direct light computed at the hit, with few and many camera rays.
// The last line counts how many estimates are within a factor of two,
// or below 0.002 like the error, which is as far as the noise of reference/images lets one see.
#include "bench/truth.h"
#include "image/metrics/relative_error.h"
#include "radiosity/scene/small_elements.h"
#include "raytrace/error/picture_error.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

using namespace meninas;
using namespace meninas::bench;

namespace {

struct Sweep {
  double elements;
  int rays;
  std::vector<std::pair<DiffuseTerm, int>> pictures; ///< with so many samples
};

const std::vector<Sweep> sweeps{
    {600, 64, {{DiffuseTerm::interpolated, 4}, {DiffuseTerm::direct, 4}}},
    {2250, 32, {{DiffuseTerm::interpolated, 16}}},
    {2250,
     128,
     {{DiffuseTerm::interpolated, 1}, {DiffuseTerm::interpolated, 16}, {DiffuseTerm::direct, 4}}},
    {6000,
     128,
     {{DiffuseTerm::interpolated, 4}, {DiffuseTerm::interpolated, 16}, {DiffuseTerm::direct, 16}}}};

const char* short_name(DiffuseTerm term) {
  return term == DiffuseTerm::interpolated ? "interpolated" : "direct";
}

struct Tally {
  int settings = 0, within = 0;
};

Tally measure_scene(const std::filesystem::path& references, const std::filesystem::path& file) {
  const Truth truth = read_truth(references, file);
  const Scene& scene = truth.scene;
  Tally tally;
  for (const Sweep& sweep : sweeps) {
    TwoPassSettings settings = two_pass_settings(RunSettings{});
    settings.pass_one.mesh.target_elements = sweep.elements;
    settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = sweep.rays;
    settings.pass_one.direct.penumbra_rays = sweep.rays / 4;
    settings.render.width = truth.mean.width;
    settings.render.height = truth.mean.height;
    const auto prepared = prepare_scene(scene, settings.pass_one);
    const Camera& camera = prepared->scene.cameras.empty()
                               ? default_camera(bounds_of(prepared->scene))
                               : prepared->scene.cameras.front();
    const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
    const LightScene& lit = *solution.field.scene;
    const auto emits = emitter_pixels(solution.field, camera, settings.render, truth.mean, 16);
    for (const auto& [term, samples] : sweep.pictures) {
      settings.render.samples = samples;
      settings.render.diffuse.term = term;
      Stopwatch watch;
      const Image picture = render(solution.field, camera, settings.render).image;
      const double seconds = watch.lap() + solution.seconds.form_factors + solution.seconds.solve +
                             solution.seconds.interpolate;
      const PictureError e =
          estimate_error(solution.field, camera, settings, solution.solver, {picture, {}},
                         error_settings(settings, sampled_elements(lit)));
      const double error =
          relative_error(picture, truth.mean, emits, truth.variance ? &*truth.variance : nullptr);
      const double ratio = e.total / error;
      constexpr double seen = 0.002;
      const bool within = (ratio > 0.5 && ratio < 2.0) || std::max(e.total, error) < seen;
      tally.settings += 1;
      tally.within += within ? 1 : 0;
      fmt::print(
          "{:15} {:6} {:4} {:12} {:3}  mesh {:.4f} factors {:.4f} tail {:.4f} pixels {:.4f} solver "
          "{:.4f}  estimate {:.4f} error {:.4f} ratio {:5.2f}{} {:.3f} of the time\n",
          file.stem().string(), element_count(lit.mesh), sweep.rays, short_name(term), samples,
          e.mesh, e.form_factors, e.mirror_tail, e.pixels, e.solver, e.total, error, ratio,
          within ? ' ' : '*', e.seconds / seconds);
      std::fflush(stdout);
    }
  }
  return tally;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("error_estimates REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    Tally all;
    for (int k = 2; k < argc; ++k) {
      const Tally tally = measure_scene(argv[1], argv[k]);
      all.settings += tally.settings;
      all.within += tally.within;
    }
    fmt::print("within a factor of two: {} of {}\n", all.within, all.settings);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
