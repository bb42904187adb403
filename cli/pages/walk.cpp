#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/light/lamp_options.h"
#include "cli/pixel_options.h"
#include "cli/values.h"
#include "runs/walk/walk_run.h"

namespace meninas {
namespace {

struct WalkOptions {
  CommonOptions common;
  WalkRequest request;
};

void run(const Options& command, WalkOptions& options) {
  if (options.request.solution) {
    refuse_pass_one_options(command, "has no effect with --solution: pass one is not run");
    refuse(command, {"--by-lamp"}, "has no effect with --solution, which knows its lamps apart or does not");
  }
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  walk_run(options.request, console.events());
}

} // namespace

Command add_walk_command(Options& program) {
  Options& command =
      program.add_command("walk", "Write one HTML file to walk through the solved room");
  const auto options = std::make_shared<WalkOptions>();
  add_scene(command, options->common);
  command
      .add("-o,--output", "FILE", "page, .html; any browser with WebGL 2 shows it, from disk",
           [=](const std::string& text) { options->request.page = text; })
      .required();
  add_file(command, "--solution", options->request.solution,
           "show a solution written by `meninas solve` instead of solving");
  command.add("--exposure", "EV", "brighten the page by so many stops [automatic, by camera]",
              [=](const std::string& text) {
                options->request.exposure = parse_number("--exposure", text, Sign::any);
              });
  add_by_lamp(command,
              "give the page a dimmer and a colour for each lamp; a --solution by `solve --by-lamp` "
              "has them without it [by node]",
              options->common.settings.lamps);
  add_lamp_factors(command,
                   "begin with a lamp so many times as bright, or of another colour; `all` is every "
                   "lamp, the last word counts; may be given several times [1]",
                   options->common.settings.lamp_factors);
  add_view_transform(command, "how the page shows what is brighter than a display",
                     options->request.transform, "Page");
  add_solve_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
