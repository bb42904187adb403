#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/bake/bake_run.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace meninas {
namespace {

struct BakeOptions {
  CommonOptions common;
  BakeRequest request;
};

int parse_lightmap_size(const std::string& text) {
  const double size = parse_number("--lightmap-size", text, Sign::positive);
  if (size != std::floor(size) || size < min_lightmap || size > largest_lightmap)
    throw UsageError("--lightmap-size", fmt::format("'{}' is no whole number from {} to {}", text, min_lightmap,
                                                    largest_lightmap));
  return static_cast<int>(size);
}

bool parse_direct(const std::string& text) {
  if (text != "on" && text != "off")
    throw UsageError("--direct", fmt::format("'{}' is neither on nor off", text));
  return text == "on";
}

void run(const Options& command, BakeOptions& options) {
  if (options.request.solution)
    refuse_pass_one_options(command, "has no effect with --solution: pass one is not run");
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  bake_run(options.request, console.events());
}

} // namespace

Command add_bake_command(Options& program) {
  Options& command = program.add_command("bake", "Write the scene's own file with lightmaps of its light");
  const auto options = std::make_shared<BakeOptions>();
  add_scene(command, options->common);
  command
      .add("-o,--output", "FILE", "baked scene, .glb; its lightmap is written beside it, .lightmap.exr and .lightmap.png",
           [=](const std::string& text) { options->request.baked = text; })
      .required();
  command.add("--lightmap-size", "N", fmt::format("use at most so many texels a side [{}]", BakeRequest{}.lightmap_size),
              [=](const std::string& text) { options->request.lightmap_size = parse_lightmap_size(text); });
  command.add("--direct", "on|off", "bake the light that comes straight from lamps as well, or what is reflected alone [on]",
              [=](const std::string& text) { options->request.direct = parse_direct(text); });
  add_file(command, "--solution", options->request.solution,
           "bake a solution written by `meninas solve` instead of solving");
  add_solve_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
