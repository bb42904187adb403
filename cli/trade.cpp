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

Command add_trade_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "trade", "Measure what a second buys: time and error over settings, with a page to look at");
  const auto options = std::make_shared<TradeOptions>();
  TradeRequest& request = options->request;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description,
                       std::function<void(const std::string&)> take) {
    command->add_option_function<std::string>(option, take, description)->type_name(shown);
  };
  add_scene(*command, options->common);
  command->add_option("-o,--output", request.folder, "folder of the page, made if it is not there")
      ->type_name("DIR")
      ->required();
  add_file(*command, "--reference", request.reference,
           "linear picture of this view to measure errors against [path tracing, for 30 % of the "
           "budget]");
  add("--budget", "SECONDS", fmt::format("time for all measurements [{}]", request.budget),
      [=](const std::string& text) {
        options->request.budget = parse_number("--budget", text, Sign::positive);
      });
  add("--camera", "NAME", "camera to render [the first]",
      [=](const std::string& text) { options->request.camera = text; });
  add("--size", "WxH", "size in pixels [as the reference, or 256 rows]",
      [=](const std::string& text) { options->request.size = parse_size("--size", text); });
  add_light_options(*command, options->common);
  add_run_options(*command, options->common);
  return {command, [=] { run(*options); }};
}

} // namespace meninas
