// What meshes cost and what they bring:
// picture error against number of elements and time, for uniform and hierarchical meshes
// (docs/notes/hierarchical.md has the table).
//
//   meshes REFERENCES RAYS SCENE.gltf ...
//
// RAYS of a vertex; 512 are those of `normal`. REFERENCES has NAME.reference.exr,
// as reference/images. Where meshes differ by less than a per cent,
// the noise of those with 512 samples a pixel hides it:
// `render --mode reference --size 96x96 --samples 8192 --float` makes better ones.
// Errors are those of bench/truth.h. Pass two takes many samples a pixel, so that its own
// does not either. Time is processor time of pass one, which other programs on the machine
// disturb less than that of a clock, and the shortest of up to five runs, which end after 20 s.
// For every other mesh stands the number of elements, and the time, that uniform meshes
// take for its error (log-log between the two nearest, beyond the last by their slope).
#include "bench/truth.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr int samples = 1024;
constexpr int max_runs = 5; // the shortest counts
constexpr double enough_seconds = 20.0;

struct Measured {
  std::size_t elements = 0;
  double seconds = 0.0, error = 0.0;
};

Measured measure(const Scene& scene, const Truth& truth, int rays, TwoPassSettings settings) {
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = rays;
  settings.render.width = truth.mean.width;
  settings.render.height = truth.mean.height;
  settings.render.samples = samples;
  double seconds = std::numeric_limits<double>::infinity(), all = 0.0;
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution;
  for (int run = 0; run < max_runs && all < enough_seconds; ++run) {
    const double before = processor_seconds();
    prepared = prepare_scene(scene, settings.pass_one);
    solution = solve_pass_one(prepared->light(), settings.pass_one);
    const double taken = processor_seconds() - before;
    seconds = std::min(seconds, taken);
    all += taken;
  }
  const LightScene& lit = *solution.field.scene;
  const Image picture =
      render(solution.field, prepared->scene.cameras.front(), settings.render).image;
  return {element_count(lit.mesh), seconds, error_of(picture, truth)};
}

/// What uniform meshes need for an error:
/// their elements or seconds, on the line through the two whose errors are nearest around it.
double needed(const std::vector<Measured>& uniform, double error, double (*what)(const Measured&)) {
  std::size_t k = 0;
  while (k + 2 < uniform.size() && uniform[k + 1].error > error)
    ++k;
  const double slope = std::log(what(uniform[k + 1]) / what(uniform[k])) /
                       std::log(uniform[k + 1].error / uniform[k].error);
  return what(uniform[k]) * std::pow(error / uniform[k].error, slope);
}

void measure_scene(const std::filesystem::path& references, const std::filesystem::path& file,
                   int rays) {
  const Truth truth = read_truth(references, file);
  const Scene& scene = truth.scene;
  fmt::print("\n{}\n{:>22} {:>9} {:>9} {:>9}   {}\n", file.stem().string(), "mesh", "elements",
             "seconds", "error", "uniform for this error: elements, seconds");
  std::vector<Measured> uniform;
  for (const double elements : {500.0, 1000.0, 2000.0, 4000.0, 8000.0, 16000.0, 32000.0}) {
    RunSettings run;
    run.mesh = MeshCut::uniform;
    TwoPassSettings settings = two_pass_settings(run);
    settings.pass_one.mesh.target_elements = elements;
    uniform.push_back(measure(scene, truth, rays, settings));
    const Measured& m = uniform.back();
    fmt::print("{:>22} {:9} {:9.3f} {:9.5f}\n", "uniform", m.elements, m.seconds, m.error);
    std::fflush(stdout);
  }
  const auto beside_uniform = [&](const std::string& name, const TwoPassSettings& settings) {
    const Measured m = measure(scene, truth, rays, settings);
    const double elements =
        needed(uniform, m.error, [](const Measured& u) { return double(u.elements); });
    const double seconds = needed(uniform, m.error, [](const Measured& u) { return u.seconds; });
    fmt::print("{:>22} {:9} {:9.3f} {:9.5f}   {:.0f} = {:.1f} x, {:.3f} = {:.1f} x\n", name,
               m.elements, m.seconds, m.error, elements, elements / double(m.elements), seconds,
               seconds / m.seconds);
    std::fflush(stdout);
  };
  for (const auto& [elements, bend] :
       {std::pair(1000.0, 0.02), std::pair(2000.0, 0.02), std::pair(4000.0, 0.02),
        std::pair(8000.0, 0.02), std::pair(8000.0, 0.01), std::pair(16000.0, 0.02),
        std::pair(16000.0, 0.01), std::pair(16000.0, 0.005), std::pair(32000.0, 0.01),
        std::pair(32000.0, 0.005), std::pair(64000.0, 0.005)}) {
    RunSettings run;
    run.mesh = MeshCut::hierarchical;
    run.link_error = bend;
    TwoPassSettings settings = two_pass_settings(run);
    settings.pass_one.mesh.target_elements = elements;
    beside_uniform(fmt::format("hierarchical {}", run.link_error.value()), settings);
  }
}

} // namespace

int main(int argc, char** argv) {
  const int rays = argc < 4 ? 0 : std::atoi(argv[2]);
  if (rays < 1) {
    fmt::print("meshes REFERENCES RAYS SCENE.gltf ...\n");
    return 2;
  }
  try {
    for (int k = 3; k < argc; ++k)
      measure_scene(argv[1], argv[k], rays);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
