#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/compare_run.h"

#include <fmt/format.h>

namespace meninas {
namespace {

struct CompareOptions {
  CommonOptions common;
  CompareRequest request;
};

void run(const CLI::App& command, CompareOptions& options) {
  if (options.request.reference == WithReference::no) {
    for (const char* option : {"--max-error", "--max-seconds"}) {
      if (command.count(option) > 0) {
        throw UsageError(option, "has no effect without --reference");
      }
    }
  }
  check_pass_one_options(command, options.common.settings);
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  console.say_notes(options.common);
  compare_run(options.request, console.events());
}

void add_view_options(CLI::App& command, CompareOptions& options) {
  CompareRequest& request = options.request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description,
                       std::function<void(const std::string&)> take) {
    command.add_option_function<std::string>(option, take, description)
        ->type_name(shown)
        ->group("Picture");
  };
  add("--camera", "NAME", "camera to render [the first]",
      [&](const std::string& text) { request.camera = text; });
  const PictureSize standard;
  add("--size", "WxH",
      fmt::format("size in pixels [{}x{}, or as wide as the camera asks]", standard.width, standard.height),
      [&](const std::string& text) { request.size = parse_size("--size", text); });
  add("--samples", "N", "camera rays per pixel, a power of two [as render]",
      [&](const std::string& text) {
        options.common.settings.samples =
            static_cast<int>(parse_integer("--samples", text, 1, 1 << 16));
      });
  add("--exposure", "EV", "brighten all pictures by so many stops [automatic]",
      [&](const std::string& text) {
        request.exposure = parse_number("--exposure", text, Sign::any);
      });
}

void add_reference_options(CLI::App& command, CompareOptions& options) {
  const char* const group = "Reference";
  command
      .add_flag_callback(
          "--reference", [&] { options.request.reference = WithReference::yes; },
          "add the picture of the path tracer")
      ->group(group);
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, std::optional<double>& value) {
    command
        .add_option_function<std::string>(
            option,
            [option, &value](const std::string& text) {
              value = parse_number(option, text, Sign::positive);
            },
            description)
        ->type_name(shown)
        ->group(group);
  };
  add("--max-error", "X", "stop the path tracer at this standard error of the mean radiance",
      options.common.settings.max_error);
  add("--max-seconds", "S", "stop the path tracer after about so long", options.common.settings.max_seconds);
}

} // namespace

Command add_compare_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compare", "Render a view in every mode, with differences, figures and a page to look at");
  const auto options = std::make_shared<CompareOptions>();
  add_scene(*command, options->common);
  command->add_option("-o,--output", options->request.folder, "folder of the page, made if it is not there")
      ->type_name("DIR")
      ->required();
  add_reference_options(*command, *options);
  add_quality(*command, options->common);
  add_light_options(*command, options->common);
  add_view_options(*command, *options);
  add_mesh_options(*command, options->common);
  add_pass_one_options(*command, options->common);
  add_run_options(*command, options->common);
  return {command, [=] { run(*command, *options); }};
}

} // namespace meninas
