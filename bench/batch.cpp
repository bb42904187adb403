// What a batch of many views costs beside one solve and as many renders,
// and what a second thread brings.
//
//   bench/batch [SCENE [VIEWS [WIDTH]]]
//
// Each round measures in turn: one solve and all renders one after the other, by all threads;
// the batch of the same pictures by all threads; the batch by one thread. All of them load
// the scene, solve, render and write EXRs. The figures are medians of the rounds' ratios.
#include "runs/batch/batch_run.h"
#include "runs/outputs.h"
#include "runs/resources.h"
#include "scenes/gltf/gltf.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace meninas {
namespace {

namespace fs = std::filesystem;

struct Settings {
  fs::path scene = MENINAS_BENCH_SCENE;
  int views = 100;
  int width = 320;
};

std::vector<BatchPicture> planned(const Settings& settings) {
  JobMode mode;
  mode.name = "hybrid";
  mode.settings = {{"mode", "hybrid"}};
  mode.request.settings.quality = Quality::draft;
  mode.request.size = PictureSize{settings.width, settings.width * 3 / 4};
  CameraPath path;
  path.name = "orbit";
  path.shape = Orbit{.centre = std::nullopt, .radius = 1.0, .from = 0.0, .to = 6.283185307179586};
  path.frames = settings.views;
  return plan_batch("bench", {BatchJob{.name = "0",
                                       .place = "/",
                                       .scenes = {settings.scene},
                                       .times = {},
                                       .cameras = {path},
                                       .modes = {mode},
                                       .outputs = {"{frame}.exr"}}});
}

/// Seconds by the clock, and of the processors:
/// what others do on the machine changes the first but hardly the second.
struct Cost {
  double wall = 0.0, processors = 0.0;
};

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <typename Work>
Cost cost_of(Work work) {
  const double before = processor_seconds();
  Stopwatch watch;
  work();
  return {watch.lap(), processor_seconds() - before};
}

void one_after_the_other(const std::vector<BatchPicture>& pictures, const fs::path& folder) {
  fs::create_directories(folder);
  RunFigures figures;
  const RunSettings& settings = pictures.front().request.settings;
  const LitScene lit =
      solve_lit_scene(load_gltf(pictures.front().scene), two_pass_settings(settings).pass_one,
                      folder / "solution.glb", {}, figures);
  for (const BatchPicture& picture : pictures) {
    const ViewPicture view = render_view(lit, picture.camera, picture.size, settings, {}, figures);
    write_pictures({folder / picture.outputs.front()}, {view.image, view.layers, &view.edges}, {},
                   view.attributes, {});
  }
}

void as_a_batch(const Settings& settings, const fs::path& folder, int threads) {
  BatchRequest request;
  request.jobs_file = "bench";
  request.folder = folder;
  request.threads = threads;
  batch_run(request, planned(settings));
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void measure(const Settings& settings, const fs::path& folder) {
  const auto pictures = planned(settings);
  one_after_the_other({pictures.front()},
                      folder / "first"); // opens the module that writes pictures
  std::vector<double> to_serial, work_to_serial, to_one_thread;
  for (int round = 0; round < 5; ++round) {
    const Cost serial = cost_of([&] { one_after_the_other(pictures, folder / "serial"); });
    const Cost batch =
        cost_of([&] { as_a_batch(settings, folder / fmt::format("all{}", round), 0); });
    const Cost alone =
        cost_of([&] { as_a_batch(settings, folder / fmt::format("one{}", round), 1); });
    fmt::print("one solve and {} renders {:.2f} s, batch {:.2f} s, batch by one thread {:.2f} s; "
               "processors {:.2f} s, {:.2f} s, {:.2f} s\n",
               settings.views, serial.wall, batch.wall, alone.wall, serial.processors,
               batch.processors, alone.processors);
    to_serial.push_back(batch.wall / serial.wall);
    work_to_serial.push_back(batch.processors / serial.processors);
    to_one_thread.push_back(alone.wall / batch.wall);
  }
  fmt::print("batch / (one solve + {} renders): {:.2f}, of the processors' time {:.2f}\n",
             settings.views, median(to_serial), median(work_to_serial));
  fmt::print("throughput by {} threads / by one: {:.2f}\n", ThreadLimit(0).threads(),
             median(to_one_thread));
  fmt::print("peak memory: {:.0f} MiB\n", double(peak_memory_bytes()) / 1048576.0);
}

} // namespace
} // namespace meninas

int main(int argc, char** argv) {
  meninas::Settings settings;
  if (argc > 1) {
    settings.scene = argv[1];
  }
  if (argc > 2) {
    settings.views = std::max(1, std::atoi(argv[2]));
  }
  if (argc > 3) {
    settings.width = std::max(4, std::atoi(argv[3]));
  }
  const auto folder =
      meninas::fs::temp_directory_path() / fmt::format("meninas-bench-{}", getpid());
  meninas::measure(settings, folder);
  meninas::fs::remove_all(folder);
}
