// Pass two beside a bare Embree loop over the same rays,
// picture size by picture size, and where the rest of the time goes.
//
//   picture_sizes [SCENE.gltf [SAMPLES [LARGEST]]]
//
// Square pictures from 64 to LARGEST pixels (4096), of SAMPLES camera rays a pixel (16)
// with mirrors followed, on one thread, in processor time. Bare loops (Embree's default
// flags) find the rays ready in packets, and look at nothing but whether they met something.
// Of the picture's rays some are sure of what they meet and are not traced (raytrace/beams/coherent_beams.h);
// of its time, the others' queries take what our own queries take for as many such rays.
// The rest finds paths, makes rays, shades what they meet, and adds up pixels.
// The three take turns, and a share is the median of those of all turns,
// so that a busy machine, which slows them alike, hardly shows.
// In a turn each goes over about as many rays: a small picture is made several times,
// so that it does not alone meet caches that hold what another has left.
#include "bench/stage_loops.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr std::size_t packet_count = 1 << 12;
constexpr double wanted_rays = 3e7;                            // of all turns
constexpr double rays_a_turn = 8 * packet_size * packet_count; // as the bare loops trace at most

/// The same packets by our own queries.
RayLoop query_loop(const LightScene& light, const StageRays& rays) {
  return [&light, &rays, met = std::make_shared<std::uint64_t>(0)] {
    HitPacket hits;
    for (int repetition = 0; repetition < 8; ++repetition)
      for (const bool first : {true, false})
        for (const RayPacket& packet : first ? rays.first : rays.reflected) {
          closest_hits(light.rays, packet, hits, first ? Backs::transparent : Backs::absorb,
                       Coherence::coherent);
          *met += hits.triangle[0];
        }
    return 8 * packet_size * (rays.first.size() + rays.reflected.size());
  };
}

void measure_size(const IrradianceField& field, const Camera& camera,
                  const BareScene& bare, RenderSettings settings, int size) {
  const LightScene& light = *field.scene;
  settings.width = settings.height = size;
  const StageRays rays = camera_rays_of(light, camera, settings, packet_count);
  const RayLoop bare_rays = bare_loop(bare, rays, Coherence::coherent);
  const RayLoop queries = query_loop(light, rays);
  const double in_picture = double(size) * size * settings.samples;
  const double per_turn = std::max(in_picture, rays_a_turn);
  double sure = 0.0;
  const RayLoop pictures = [&] {
    std::uint64_t all = 0;
    for (double made = 0.0; made < per_turn; made += in_picture) {
      const Rendering rendering = render(field, camera, settings);
      const std::uint64_t rays_of_one = rendering.camera_rays + rendering.specular_rays;
      sure = static_cast<double>(rendering.sure_rays) / static_cast<double>(rays_of_one);
      all += rays_of_one;
    }
    return all;
  };
  const int turns = static_cast<int>(std::clamp(wanted_rays / per_turn, 3.0, 101.0));
  std::vector<double> rates, share, queried;
  for (int turn = 0; turn < turns; ++turn) {
    const double a = 1.0 / rate_of(bare_rays), b = 1.0 / rate_of(queries),
                 c = 1.0 / rate_of(pictures); // microseconds a ray
    rates.push_back(1.0 / c);
    share.push_back(a / c);
    queried.push_back(100.0 * (1.0 - sure) * b / c);
  }
  fmt::print("{:>6} {:10.1f} {:12.2f} {:10.0f} % {:10.0f} % {:10.0f} %\n", size, median(rates),
             median(share), 100.0 * sure, median(queried), 100.0 - median(queried));
  std::fflush(stdout);
}

void run(const char* file, int samples, int largest) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  RunSettings chosen;
  chosen.quality = Quality::draft;
  chosen.samples = samples;
  const TwoPassSettings settings = two_pass_settings(chosen);
  const auto prepared = prepare_scene(load_gltf(file), settings.pass_one);
  const LightScene& light = *prepared->light();
  const Scene& scene = prepared->scene;
  const Camera camera =
      scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  const IrradianceField field = solve_pass_one(prepared->light(), settings.pass_one).field;
  const BareScene bare = make_bare_scene(light.rays.geometry(), RTC_SCENE_FLAG_NONE);
  fmt::print("{}: {} triangles, {} samples a pixel; million rays/s on one thread\n"
             "{:>6} {:>10} {:>12} {:>12} {:>12} {:>12}\n",
             file, scene.triangles.size(), settings.render.samples, "pixels", "ours", "of Embree's",
             "sure", "queries", "rest");
  for (int size = 64; size <= largest; size *= 2)
    measure_size(field, camera, bare, settings.render, size);
  release(bare);
}

} // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : MENINAS_BENCH_SCENE, argc > 2 ? std::atoi(argv[2]) : 16,
        argc > 3 ? std::atoi(argv[3]) : 4096);
  } catch (const UserError& error) {
    fmt::print(stderr, "picture_sizes: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
