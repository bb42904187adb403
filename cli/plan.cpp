#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/plan_run.h"
#include "scenes/errors.h"

#include <iostream>

namespace meninas {
namespace {

struct PlanOptions {
  CommonOptions common;
  PlanRequest request;
};

void run(const Options& command, PlanOptions& options) {
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  std::cout << plan_run(options.request) << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
}

/// What else the cost of a picture depends on.
void add_picture_options(Options& command, const std::shared_ptr<PlanOptions>& options) {
  RunSettings& settings = options->common.settings;
  PlanRequest& request = options->request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, const TakeText& take) {
    command.add(option, shown, description, take).group("Picture whose cost is predicted");
  };
  add("--camera", "NAME", "camera to render [the first]",
      [&request](const std::string& text) { request.camera = text; });
  add("--size", "WxH", "size in pixels [as render]",
      [&request](const std::string& text) { request.size = parse_size("--size", text); });
  add("--samples", "N", "camera rays per pixel [as render]", [&settings](const std::string& text) {
    settings.samples = static_cast<int>(parse_integer("--samples", text, 1, 1 << 24));
  });
  add("--diffuse", "interpolated|direct|gather", "light on diffuse surfaces [as render]",
      [&settings](const std::string& text) { settings.diffuse = parse_diffuse(text); });
  add("--threads", "N", "number of threads [all cores]", [&settings](const std::string& text) {
    settings.threads = static_cast<int>(parse_integer("--threads", text, 1, 1024));
  });
}

} // namespace

Command add_plan_command(Options& program) {
  Options& command =
      program.add_command("plan", "Say what a scene contains and what will be modelled");
  const auto options = std::make_shared<PlanOptions>();
  add_scene(command, options->common);
  command.add_flag("--json", "print JSON", [=] { options->request.format = PlanFormat::json; });
  add_quality(command, options->common);
  add_state_options(command, options->common);
  add_light_options(command, options->common);
  add_mesh_options(command, options->common);
  add_pass_one_options(command, options->common);
  add_picture_options(command, options);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
