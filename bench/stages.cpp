// Rates of the two ray-bound stages beside bare Embree loops over the same rays,
// and the share of the bare loop that is reached.
//
//   stages [SCENE.gltf]
//
// Form factors: every leg of assemble_transport at quality `normal`. Pass two:
// camera and specular rays of a 512 x 512 picture with 16 samples a pixel. Bare loops trace
// rays that go on behind mirrors in the same proportion, but find them ready in packets.
// Figures are of one thread, in processor time. The loops take turns, and a share is the median
// of those of all turns, so that a busy machine, which slows them alike, hardly shows.
#include "bench/stage_loops.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <functional>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr std::size_t packet_count = 1 << 12;
constexpr int turns = 15;

struct StageLoops {
  std::function<std::uint64_t()> plain, robust, ours;
};

void report(const std::string& name, const StageLoops& loops) {
  std::vector<double> plain, robust, ours, of_plain, of_robust;
  for (int turn = 0; turn < turns; ++turn) {
    plain.push_back(rate_of(loops.plain));
    robust.push_back(rate_of(loops.robust));
    ours.push_back(rate_of(loops.ours));
    of_plain.push_back(ours.back() / plain.back());
    of_robust.push_back(ours.back() / robust.back());
  }
  fmt::print("{:<14}{:>10.1f}{:>10.1f}{:>10.1f}{:>14.2f}{:>14.2f}\n", name, median(plain),
             median(robust), median(ours), median(of_plain), median(of_robust));
}

StageLoops stage(const BareScene& plain, const BareScene& robust, const StageRays& rays,
                 Coherence first, std::function<std::uint64_t()> ours) {
  return {bare_loop(plain, rays, first), bare_loop(robust, rays, first), std::move(ours)};
}

void run(const char* file) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TwoPassSettings settings = two_pass_settings(RunSettings{});
  const auto prepared = prepare_scene(load_gltf(file), settings.pass_one);
  const LightScene& light = *prepared->light();
  const Scene& scene = prepared->scene;
  const Camera camera =
      scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  const IrradianceField field = solve_pass_one(prepared->light(), settings.pass_one).field;
  const FormFactorSettings& form_factors = settings.pass_one.form_factors;

  const StageRays gathered = gather_rays_of(light, form_factors.rays, packet_count);
  const StageRays seen = camera_rays_of(light, camera, settings.render, packet_count);
  const BareScene plain = make_bare_scene(light.rays.geometry(), RTC_SCENE_FLAG_NONE);
  const BareScene robust = make_bare_scene(light.rays.geometry(), RTC_SCENE_FLAG_ROBUST);
  fmt::print("{}: {} triangles, {} elements; million rays/s on one thread\n"
             "{:<14}{:>10}{:>10}{:>10}{:>14}{:>14}\n",
             file, scene.triangles.size(), light.mesh.area.size(), "", "default", "robust", "ours",
             "of default", "of robust");
  report("form factors", stage(plain, robust, gathered, Coherence::coherent, [&] {
           return assemble_transport(light, form_factors).rays_traced;
         }));
  report("pass two", stage(plain, robust, seen, Coherence::coherent, [&] {
           const Rendering rendering = render(field, camera, settings.render);
           return rendering.camera_rays + rendering.specular_rays;
         }));
  release(plain);
  release(robust);
}

} // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : MENINAS_BENCH_SCENE);
  } catch (const UserError& error) {
    fmt::print(stderr, "stages: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
