// What each diffuse term of pass two costs and what it brings:
// error against the reference and seconds, scene by scene (docs/notes/pass_two.md has the table).
//
//   diffuse_terms REFERENCES SCENE.gltf ...
//
// REFERENCES is the folder of reference/images. One solve serves all terms of a scene.
// Pictures have the reference's size; errors are those of bench/truth.h.
// Seconds are processor time, of pass one and of each pass two.
#include "bench/truth.h"
#include "raytrace/two_pass.h"
#include "runs/run_settings.h"

#include <fmt/format.h>

#include <array>

using namespace meninas;
using namespace meninas::bench;

namespace {

constexpr int samples = 64;

void measure_scene(const std::filesystem::path& references, const std::filesystem::path& file) {
  const Truth truth = read_truth(references, file);
  RunSettings run;
  run.quality = Quality::draft;
  run.samples = samples;
  const PassOneSettings pass_one = two_pass_settings(run).pass_one;
  const double before = processor_seconds();
  const auto prepared = prepare_scene(truth.scene, pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), pass_one);
  fmt::print("| `{}` | {:.2f} |", file.stem().string(), processor_seconds() - before);
  for (const DiffuseTerm term :
       {DiffuseTerm::interpolated, DiffuseTerm::direct, DiffuseTerm::gather}) {
    run.diffuse = term;
    RenderSettings settings = two_pass_settings(run).render;
    settings.width = truth.mean.width;
    settings.height = truth.mean.height;
    const double start = processor_seconds();
    const Image picture =
        render(solution.field, prepared->scene.cameras.front(), settings).image;
    fmt::print(" {:.4f}, {:.2f} |", error_of(picture, truth), processor_seconds() - start);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("diffuse_terms REFERENCES SCENE.gltf ...\n");
    return 2;
  }
  try {
    fmt::print("| scene | pass one, s | interpolated: error, s | direct | gather |\n"
               "|---|---|---|---|---|\n");
    for (int k = 2; k < argc; ++k)
      measure_scene(argv[1], argv[k]);
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 3;
  }
}
