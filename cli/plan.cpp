#include "cli/commands.h"
#include "cli/common_options.h"
#include "runs/plan_run.h"
#include "scenes/errors.h"

#include <iostream>

namespace meninas {
namespace {

struct PlanOptions {
  CommonOptions common;
  PlanRequest request;
};

void run(PlanOptions& options) {
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  std::cout << plan_run(options.request) << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
}

} // namespace

Command add_plan_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("plan", "Say what a scene contains and what will be modelled");
  const auto options = std::make_shared<PlanOptions>();
  add_scene(*command, options->common);
  command->add_flag_callback(
      "--json", [=] { options->request.format = PlanFormat::json; }, "as JSON instead of text");
  add_quality(*command, options->common);
  add_light_options(*command, options->common);
  add_mesh_options(*command, options->common);
  return {command, [=] { run(*options); }};
}

} // namespace meninas
