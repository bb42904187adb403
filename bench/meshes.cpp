// What meshes cost and what they bring: picture error against number of elements and time, uniform and adaptive (ARCHITECTURE.md has the table).
//
//   meshes REFERENCES SCENE.gltf ...
//
// REFERENCES is the folder of reference/images. The error of a picture p against the reference r, both of the size of r, is
//
//   e^2 = mean over pixels and channels of ((p - r)^2 - v) / (r + mean r)^2
//
// with v the variance of r, so that the noise of the reference does not count. Pass two takes many samples a pixel, so that its own does not
// either. Time is processor time of pass one, which other programs on the machine disturb less than that of a clock.
// For every adaptive mesh stands the number of elements, and the time, that uniform meshes take for its error (log-log between the two nearest,
// beyond the last by their slope).
#include "image/image_file.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

using namespace meninas;

namespace {

constexpr int samples = 256;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Truth {
  Image mean, variance;
};

Truth read_truth(const std::filesystem::path& file) {
  ImageFile picture = read_image(file);
  const auto variance = std::ranges::find(picture.layers, "variance", &Layer::name);
  if (variance == picture.layers.end())
    throw InputError(file.string(), "", "has no layer of variances");
  return {std::move(picture.picture), std::move(variance->image)};
}

double error_of(const Image& picture, const Truth& truth) {
  glm::dvec3 mean(0.0);
  for (const glm::vec3& pixel : truth.mean.pixels)
    mean += glm::dvec3(pixel) / double(truth.mean.pixels.size());
  double sum = 0.0;
  for (std::size_t p = 0; p < picture.pixels.size(); ++p)
    for (int band = 0; band < 3; ++band) {
      const double r = double{truth.mean.pixels[p][band]},
                   off = double{picture.pixels[p][band]} - r;
      sum += (off * off - double{truth.variance.pixels[p][band]}) / std::pow(r + mean[band], 2.0);
    }
  return std::sqrt(std::max(sum, 0.0) / (3.0 * double(picture.pixels.size())));
}

struct Measured {
  std::size_t elements = 0;
  double seconds = 0.0, error = 0.0;
};

Measured measure(const Scene& scene, const Truth& truth, TwoPassSettings settings) {
  settings.render.width = truth.mean.width;
  settings.render.height = truth.mean.height;
  settings.render.samples = samples;
  const double before = processor_seconds();
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(*prepared->light, settings.pass_one);
  const double seconds = processor_seconds() - before;
  const LightScene& lit = field_scene(*prepared->light, solution);
  const Image picture =
      render(lit, solution.field, prepared->scene.cameras.front(), settings.render).image;
  return {element_count(lit.mesh), seconds, error_of(picture, truth)};
}

/// What uniform meshes need for an error: their elements or seconds, on the line through the two whose errors are nearest around it.
double needed(const std::vector<Measured>& uniform, double error, double (*what)(const Measured&)) {
  std::size_t k = 0;
  while (k + 2 < uniform.size() && uniform[k + 1].error > error)
    ++k;
  const double slope = std::log(what(uniform[k + 1]) / what(uniform[k])) /
                       std::log(uniform[k + 1].error / uniform[k].error);
  return what(uniform[k]) * std::pow(error / uniform[k].error, slope);
}

void measure_scene(const std::filesystem::path& references, const std::filesystem::path& file) {
  const Scene scene = load_gltf(file);
  const Truth truth = read_truth(references / (file.stem().string() + ".reference.exr"));
  fmt::print("\n{}\n{:>22} {:>9} {:>9} {:>9}   {}\n", file.stem().string(), "mesh", "elements",
             "seconds", "error", "uniform for this error: elements, seconds");
  std::vector<Measured> uniform;
  for (const double elements : {500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0, 32000.0}) {
    TwoPassSettings settings = two_pass_settings(RunSettings{});
    settings.pass_one.mesh.target_elements = elements;
    uniform.push_back(measure(scene, truth, settings));
    const Measured& m = uniform.back();
    fmt::print("{:>22} {:9} {:9.2f} {:9.4f}\n", "uniform", m.elements, m.seconds, m.error);
    std::fflush(stdout);
  }
  for (const double bound : {0.02, 0.01, 0.005, 0.0025}) {
    RunSettings run;
    run.adaptive = WithAdaptivity::yes;
    run.adaptive_error = bound;
    const Measured m = measure(scene, truth, two_pass_settings(run));
    const double elements =
        needed(uniform, m.error, [](const Measured& u) { return double(u.elements); });
    const double seconds = needed(uniform, m.error, [](const Measured& u) { return u.seconds; });
    fmt::print("{:>22} {:9} {:9.2f} {:9.4f}   {:.0f} = {:.1f} x, {:.2f} = {:.1f} x\n",
               fmt::format("adaptive {}", bound), m.elements, m.seconds, m.error, elements,
               elements / double(m.elements), seconds, seconds / m.seconds);
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("meshes REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    for (int k = 2; k < argc; ++k)
      measure_scene(argv[1], argv[k]);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
