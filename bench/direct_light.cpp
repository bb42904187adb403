// The cost of direct irradiance:
// by receiver and mirror world, by number of emitters, and what mirrors cost pass one.
//
// Worlds: a room whose side walls face each other as mirrors, the tree cut at so many worlds;
// one receiver at a time.
// Emitters: small lamps all over a ceiling, the same power in all;
// with the choice of images the time per receiver must not grow in proportion.
// Elements: the means over the elements of a gallery scene as `--quality normal` finds them:
// seconds of one thread, and how far off they are (root mean square over the mean,
// and the worst element) from means over many times as many points.
// Pass one: the Cornell box with its mirror, and with the mirror painted grey;
// the ratio of their times is the counter `ratio`.
#include "radiosity/light/element_light.h"
#include "radiosity/pass_one.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"
#include "scenes/gltf/gltf.h"
#include "scenes/sampling.h"
#include "tests/support/rooms.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace meninas;

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Receivers on a low-discrepancy net over the floor of the unit room.
Receiver receiver_on_floor(const PreparedScene& prepared, std::uint32_t k) {
  const auto sample = sobol4(k, 1);
  Receiver receiver{{0.02 + 0.96 * double{sample[0]}, 0.0, 0.02 + 0.96 * double{sample[1]}},
                    {0.0, 1.0, 0.0}};
  receiver.plane_class = prepared.mesh.sides[0].plane_class;
  for (const MeshSide& side : prepared.mesh.sides)
    if (side.normal.y > 0.999 && std::abs(side.plane.offset) < 1e-9)
      receiver.plane_class = side.plane_class;
  return receiver;
}

void measure_receivers(benchmark::State& state, const PreparedScene& prepared) {
  constexpr std::uint32_t net = 1 << 10;
  std::vector<Receiver> receivers;
  for (std::uint32_t k = 0; k < net; ++k)
    receivers.push_back(receiver_on_floor(prepared, k));
  DirectWorkspace work;
  std::uint32_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        direct_irradiance(*prepared.light(), receivers[k % net], DirectSettings{}, k, work));
    ++k;
  }
  state.counters["shadow_rays"] =
      benchmark::Counter(static_cast<double>(work.shadow_rays), benchmark::Counter::kAvgIterations);
}

void DirectByWorlds(benchmark::State& state) {
  PassOneSettings settings;
  settings.mesh.target_elements = 1000;
  settings.plan.worlds = {
      .min_throughput = 0.0, .max_depth = static_cast<int>(state.range(0)) / 2, .max_worlds = 1000};
  const auto prepared = prepare_scene(test::facing_mirrors(Rgb(0.95)), settings);
  measure_receivers(state, *prepared);
  const auto worlds = static_cast<double>(prepared->plan.worlds.worlds.size());
  state.counters["per_world"] = benchmark::Counter(
      worlds, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(DirectByWorlds)->Arg(0)->Arg(2)->Arg(8)->Arg(32)->Arg(128);

Scene ceiling_of_lamps(int rows) {
  using test::diffuse;
  Scene scene;
  test::add_room(
      scene, Point3(0.0), Point3(1.0),
      {test::mirror(0.9), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
  const Material glow = diffuse(0.0, 10.0);
  const double pitch = 1.0 / rows, size = 0.3 * pitch;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const double x = (i + 0.35) * pitch, z = (j + 0.35) * pitch;
      test::add_polygon(
          scene, "lamp",
          {{x, 0.98, z}, {x + size, 0.98, z}, {x + size, 0.98, z + size}, {x, 0.98, z + size}},
          glow);
    }
  return scene;
}

void DirectByEmitters(benchmark::State& state) {
  const auto rows = static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0)))));
  PassOneSettings settings;
  settings.mesh.target_elements = 1000;
  measure_receivers(state, *prepare_scene(ceiling_of_lamps(rows), settings));
}
BENCHMARK(DirectByEmitters)->Arg(16)->Arg(64)->Arg(256)->Arg(1024)->Arg(4096);

/// The mirror painted grey: the same geometry, but nothing to reflect in.
Scene without_mirrors(Scene scene) {
  for (Material& material : scene.materials)
    if (is_mirror(material))
      material = test::diffuse(0.5);
  return scene;
}

double pass_one_seconds(const Scene& scene, const PassOneSettings& settings) {
  const double start = processor_seconds();
  const auto prepared = prepare_scene(scene, settings);
  benchmark::DoNotOptimize(solve_pass_one(prepared->light(), settings));
  return processor_seconds() - start;
}

/// The two scenes take turns, so that a busy machine slows them alike;
/// processor time of one thread.
void PassOneThroughMirrors(benchmark::State& state) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const PassOneSettings settings = two_pass_settings(RunSettings{}).pass_one;
  const Scene with = load_gltf(MENINAS_BENCH_SCENE), without = without_mirrors(with);
  std::vector<double> ratios;
  for (auto _ : state)
    ratios.push_back(pass_one_seconds(with, settings) / pass_one_seconds(without, settings));
  std::ranges::sort(ratios);
  state.counters["ratio"] = ratios[ratios.size() / 2];
}
BENCHMARK(PassOneThroughMirrors)->Unit(benchmark::kSecond)->Iterations(3);

/// How far means are from true ones, relative to the scene's mean, in the brightest channel.
struct MeanErrors {
  double rms = 0.0, worst = 0.0;
};
MeanErrors errors_of(const std::vector<Rgb>& means, const std::vector<Rgb>& truth) {
  double mean = 0.0;
  MeanErrors errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Rgb off = glm::abs(means[i] - truth[i]);
    const double most = std::max({off.r, off.g, off.b});
    errors.rms += most * most;
    errors.worst = std::max(errors.worst, most);
    mean += std::max({truth[i].r, truth[i].g, truth[i].b});
  }
  const auto count = static_cast<double>(truth.size());
  mean /= count;
  return {std::sqrt(errors.rms / count) / mean, errors.worst / mean};
}

void DirectOnElements(benchmark::State& state, const std::string& name) {
  PassOneSettings settings = two_pass_settings(RunSettings{}).pass_one;
  settings.mesh.target_elements = 2000;
  const auto prepared =
      prepare_scene(load_gltf(std::string(MENINAS_BENCH_GALLERY) + name + ".gltf"), settings);
  DirectSettings fine = settings.direct;
  fine.points = fine.max_points = 2048;
  fine.rays_in_element = 4;
  fine.seed = 1;
  const DirectIrradiance truth = direct_irradiance(*prepared->light(), {}, fine);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  DirectIrradiance means;
  for (auto _ : state)
    means = direct_irradiance(*prepared->light(), {}, settings.direct);
  const MeanErrors errors = errors_of(means.irradiance, truth.irradiance);
  state.counters["rms"] = errors.rms;
  state.counters["worst"] = errors.worst;
  state.counters["shadow_rays"] = static_cast<double>(means.shadow_rays);
}
BENCHMARK_CAPTURE(DirectOnElements, cornell, "cornell")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(DirectOnElements, cornell_mirror, "cornell-mirror")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(DirectOnElements, mirror_spot, "mirror-spot")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(DirectOnElements, half_room, "half-room")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(DirectOnElements, meninas, "meninas")->Unit(benchmark::kSecond);

} // namespace

BENCHMARK_MAIN();
