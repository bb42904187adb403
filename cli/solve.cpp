#include "cli/commands.h"
#include "cli/common_options.h"
#include "runs/solve_run.h"

namespace meninas {
namespace {

struct SolveOptions {
  CommonOptions common;
  SolveRequest request;
};

void run(const Options& command, SolveOptions& options) {
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  solve_run(options.request, console.events());
}

} // namespace

Command add_solve_command(Options& program) {
  Options& command = program.add_command("solve", "Solve pass one once, for any number of views");
  const auto options = std::make_shared<SolveOptions>();
  add_scene(command, options->common);
  command
      .add("-o,--output", "FILE", "solution, .glb; any glTF viewer shows it",
           [=](const std::string& text) { options->request.solution = text; })
      .required();
  add_file(command, "--per-node", options->request.per_node,
           "write area, emission, radiosity and irradiance of each glTF node as JSON");
  add_file(command, "--stats", options->request.stats, "write the figures of the run as JSON");
  add_file(command, "--factors", options->request.factors, "write the form factors for later runs");
  add_file(command, "--reuse", options->request.reuse,
           "use the form factors of an earlier run; only emission and diffuse reflectances may "
           "have changed");
  add_quality(command, options->common);
  add_state_options(command, options->common);
  add_light_options(command, options->common);
  add_mesh_options(command, options->common);
  add_pass_one_options(command, options->common);
  add_run_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
