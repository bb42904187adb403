#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/trade/trade_run.h"

#include <fmt/format.h>

namespace meninas {
namespace {

struct TradeOptions {
  CommonOptions common;
  TradeRequest request;
};

void run(TradeOptions& options) {
  options.request.scene = options.common.scene;
  options.request.settings = options.common.settings;
  Console console(options.common.verbosity);
  trade_run(options.request, console.events());
}

} // namespace

Command add_trade_command(Options& program) {
  Options& command = program.add_command(
      "trade", "Measure time against error of many settings, as a page");
  const auto options = std::make_shared<TradeOptions>();
  TradeRequest& request = options->request;
  add_scene(command, options->common);
  command
      .add("-o,--output", "DIR", "folder of the page, made if it is not there",
           [=](const std::string& text) { options->request.folder = text; })
      .required();
  add_file(command, "--reference", request.reference,
           "linear picture of this view to measure errors against [path tracing, for 30 % of the "
           "budget]");
  command.add("--budget", "SECONDS", fmt::format("time for all measurements [{}]", request.budget),
              [=](const std::string& text) {
                options->request.budget = parse_number("--budget", text, Sign::positive);
              });
  command.add("--camera", "NAME", "camera to render [the first]",
              [=](const std::string& text) { options->request.camera = text; });
  command.add("--size", "WxH", "size in pixels [as the reference, or 256 rows]",
              [=](const std::string& text) { options->request.size = parse_size("--size", text); });
  add_state_options(command, options->common);
  add_light_options(command, options->common);
  add_run_options(command, options->common);
  return {&command, [=] { run(*options); }};
}

} // namespace meninas
