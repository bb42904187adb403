#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/pixel_options.h"
#include "cli/values.h"
#include "runs/compare_run.h"

#include <fmt/format.h>

namespace meninas {
namespace {

struct CompareOptions {
  CommonOptions common;
  CompareRequest request;
};

void run(const Options& command, CompareOptions& options) {
  if (options.request.reference == WithReference::no) {
    for (const char* option : {"--max-error", "--max-seconds"}) {
      if (command.given(option)) {
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

void add_view_options(Options& command, CompareOptions& options) {
  CompareRequest& request = options.request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, const TakeText& take) {
    command.add(option, shown, description, take).group("Picture");
  };
  add("--camera", "NAME", "camera to render [the first]",
      [&](const std::string& text) { request.camera = text; });
  add_projection(command, options.common.settings, "Picture");
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
  add_view_transform(command, "how PNGs and the page show what is brighter than a display",
                     request.transform, "Picture");
}

void add_reference_options(Options& command, CompareOptions& options) {
  const char* const group = "Reference";
  command
      .add_flag("--reference", "add the picture of the path tracer",
                [&] { options.request.reference = WithReference::yes; })
      .group(group);
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description, std::optional<double>& value) {
    command
        .add(option, shown, description,
             [option, &value](const std::string& text) {
               value = parse_number(option, text, Sign::positive);
             })
        .group(group);
  };
  add("--max-error", "X", "stop the path tracer at this standard error of the mean radiance",
      options.common.settings.max_error);
  add("--max-seconds", "S", "stop the path tracer after about so long", options.common.settings.max_seconds);
}

} // namespace

Command add_compare_command(Options& program) {
  Options& command = program.add_command(
      "compare", "Compare the modes of a view, with figures, as a page");
  const auto options = std::make_shared<CompareOptions>();
  add_scene(command, options->common);
  command
      .add("-o,--output", "DIR", "folder of the page, made if it is not there",
           [=](const std::string& text) { options->request.folder = text; })
      .required();
  add_reference_options(command, *options);
  add_quality(command, options->common);
  add_state_options(command, options->common);
  add_light_options(command, options->common);
  add_view_options(command, *options);
  add_mesh_options(command, options->common);
  add_pass_one_options(command, options->common);
  add_run_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
