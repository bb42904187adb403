// How long a picture of a wanted accuracy takes, and where the time goes.
//
//   time_to_error REFERENCES SCENE.gltf ...
//   time_to_error --presets REFERENCES SCENE.gltf ...      the presets draft, normal and fine instead
//
// Every scene is rendered with a ladder of settings. The error is that of a picture of the size
// of REFERENCES/NAME.reference.exr, its variance taken off (image/metrics/relative_error.h),
// the time that of one of 256 x 256 pixels, in processor seconds of all threads, which other
// programs on the machine disturb less than a clock; on two idle cores a run takes half of it.
// For 5, 2 and 1 % stands the fastest setting that reaches it, its split by stage,
// and what share of it bare Embree loops (bare_embree.h) would take for the rays that were traced:
// the floor. Starting the program is not in it.
#include "bench/bare_embree.h"
#include "bench/stage_rays.h"
#include "bench/truth.h"
#include "image/metrics/relative_error.h"
#include "raytrace/error/probes.h"
#include "runs/run_settings.h"
#include "runs/steering/setting_options.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <optional>
#include <vector>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr int side = 256;

/// Seconds of one thread that a bare loop takes for a ray.
struct BareSeconds {
  double gathered = 0.0, shadow = 0.0, camera = 0.0;
};

double seconds_per_ray(const BareScene& bare, Query query, Coherence coherence,
                       const std::vector<RayPacket>& packets) {
  constexpr int repetitions = 4;
  std::uint64_t met = 0;
  const double before = processor_seconds();
  for (int k = 0; k < repetitions; ++k)
    for (const RayPacket& packet : packets)
      met += trace_bare(bare, query, coherence, packet);
  const double seconds = processor_seconds() - before;
  const double rays = repetitions * double(packet_size) * double(packets.size());
  return met > 0 || rays > 0.0 ? seconds / std::max(rays, 1.0) : 0.0;
}

BareSeconds bare_seconds(const LightScene& light, const Camera& camera,
                         const RenderSettings& settings) {
  constexpr std::size_t packets = 1 << 12;
  const StageRays gathered = gather_rays_of(light, 256, packets);
  const StageRays seen = camera_rays_of(light, camera, settings, packets);
  const BareScene bare = make_bare_scene(light.rays.geometry(), RTC_SCENE_FLAG_NONE);
  const BareSeconds seconds{
      seconds_per_ray(bare, Query::closest, Coherence::incoherent, gathered.first),
      seconds_per_ray(bare, Query::occlusion, Coherence::coherent, gathered.first),
      seconds_per_ray(bare, Query::closest, Coherence::coherent, seen.first)};
  release(bare);
  return seconds;
}

struct Measured {
  RunSettings settings;
  std::size_t elements = 0;
  double error = 0.0, prepare = 0.0, form_factors = 0.0, solve = 0.0, interpolate = 0.0,
         render = 0.0, floor = 0.0;
  double total() const { return prepare + form_factors + solve + interpolate + render; }
};

struct Known {
  Truth truth;
  std::vector<std::uint8_t> emits; ///< pixels that show lamps; empty: not yet looked for
};

/// Stages are timed by the clock;
/// their shares of processor time are the same where all threads work.
Measured measure(Known& known, const RunSettings& settings, std::optional<BareSeconds>& bare) {
  const Truth& truth = known.truth;
  const Scene& scene = truth.scene;
  TwoPassSettings two_pass = two_pass_settings(settings);
  Measured m{.settings = settings};
  const double begin = processor_seconds();
  const auto prepared = prepare_scene(scene, two_pass.pass_one);
  const double prepared_at = processor_seconds();
  const RadiositySolution solution = solve_pass_one(prepared->light(), two_pass.pass_one);
  const double pass_one = processor_seconds() - prepared_at;
  m.prepare = prepared_at - begin;
  const PassOneSeconds& clock = solution.seconds;
  const double scale = pass_one / (clock.form_factors + clock.solve + clock.interpolate);
  m.form_factors = scale * clock.form_factors;
  m.solve = scale * clock.solve;
  m.interpolate = scale * clock.interpolate;
  const LightScene& lit = *solution.field.scene;
  m.elements = element_count(lit.mesh);

  const Camera camera =
      scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  two_pass.render.width = two_pass.render.height = side;
  const double before = processor_seconds();
  const Rendering shown = render(solution.field, camera, two_pass.render);
  m.render = processor_seconds() - before;
  if (!bare)
    bare = bare_seconds(lit, camera, two_pass.render);
  m.floor = bare->gathered * double(solution.form_factor_rays + shown.gather_rays) +
            bare->shadow * double(solution.shadow_rays + shown.shadow_rays) +
            bare->camera * double(shown.camera_rays + shown.specular_rays);

  two_pass.render.width = truth.mean.width;
  two_pass.render.height = truth.mean.height;
  if (known.emits.empty())
    known.emits = emitter_pixels(solution.field, camera, two_pass.render, truth.mean, 16);
  m.error = relative_error(render(solution.field, camera, two_pass.render).image, truth.mean,
                           known.emits, truth.variance ? &*truth.variance : nullptr);
  return m;
}

struct PictureParameters {
  DiffuseTerm term = DiffuseTerm::interpolated;
  int samples = 16;
  std::optional<double> pixel_error = {};
};

RunSettings drafted(int elements, int rays, const PictureParameters& parameters) {
  RunSettings settings;
  settings.quality = Quality::draft;
  settings.mesh = MeshCut::uniform;
  settings.elements = elements;
  settings.rays = rays;
  settings.diffuse = parameters.term;
  settings.samples = parameters.samples;
  settings.pixel_error = parameters.pixel_error;
  return settings;
}

/// The light of lamps left to pixels or not;
/// elements that gather each for itself, or by as few nodes as it takes, where many cost little.
std::vector<RunSettings> ladder() {
  const std::vector<PictureParameters> at_pixels{{DiffuseTerm::direct, 16, 0.04},
                                            {DiffuseTerm::direct, 64, 0.02},
                                            {DiffuseTerm::direct, 256, 0.02}},
      at_vertices{{DiffuseTerm::interpolated, 16, {}}, {DiffuseTerm::interpolated, 64, 0.04}};
  std::vector<RunSettings> all;
  for (const int rays : {64, 128, 256}) {
    for (const int elements : {600, 1500, 4000, 10'000})
      for (const auto& choices : {at_vertices, at_pixels})
        for (const PictureParameters& parameters : choices) {
          all.push_back(drafted(elements, rays, parameters));
          if (parameters.term == DiffuseTerm::direct)
            all.back().bends = 0.1; // what is left between vertices are the feet of lit walls
        }
    for (const int elements : {4000, 10'000, 25'000, 64'000})
      for (const auto& choices : {at_vertices, at_pixels})
        for (const PictureParameters& parameters : choices) {
          all.push_back(drafted(elements, rays, parameters));
          all.back().mesh = MeshCut::hierarchical;
        }
  }
  return all;
}

void print(const std::string& what, const Measured& m) {
  fmt::print("{:22} {:6.2f} s  prepare {:.2f} form factors {:.2f} solve {:.2f} interpolate {:.2f} "
             "render {:.2f}  "
             "floor {:.2f} of it  error {:.4f}  {} elements  {}\n",
             what, m.total(), m.prepare, m.form_factors, m.solve, m.interpolate, m.render,
             m.floor / m.total(), m.error, m.elements, fmt::join(options_of(m.settings), " "));
  std::fflush(stdout);
}

void measure_presets(const std::string& name, Known& known) {
  std::optional<BareSeconds> bare;
  for (const Quality quality : {Quality::draft, Quality::normal, Quality::fine}) {
    RunSettings settings;
    settings.quality = quality;
    print(name + ' ' + name_of(quality), measure(known, settings, bare));
  }
}

void measure_ladder(const std::string& name, Known& known) {
  std::optional<BareSeconds> bare;
  std::vector<Measured> all;
  for (const RunSettings& settings : ladder())
    all.push_back(measure(known, settings, bare));
  for (const double wanted : {0.05, 0.02, 0.01}) {
    const Measured* best = nullptr;
    for (const Measured& m : all)
      if (m.error <= wanted && (best == nullptr || m.total() < best->total()))
        best = &m;
    const std::string what = fmt::format("{} {:.0f} %", name, 100.0 * wanted);
    if (best != nullptr)
      print(what, *best);
    else
      print(what + ": nearest", *std::ranges::min_element(all, {}, &Measured::error));
  }
}

} // namespace

int main(int argc, char** argv) {
  const bool presets = argc > 1 && std::string_view(argv[1]) == "--presets";
  const int first = presets ? 2 : 1;
  if (argc < first + 2) {
    fmt::print("time_to_error [--presets] REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    for (int k = first + 1; k < argc; ++k) {
      const std::filesystem::path file = argv[k];
      const std::string name = file.stem().string();
      Known known{read_truth(argv[first], file), {}};
      (presets ? measure_presets : measure_ladder)(name, known);
    }
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
