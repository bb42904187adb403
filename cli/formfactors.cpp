#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/formfactors_run.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

namespace meninas {
namespace {

const Choices<NodeFactorMethod> methods{{"analytic", NodeFactorMethod::analytic},
                                        {"rays", NodeFactorMethod::rays}};

struct FormFactorsOptions {
  CommonOptions common;
  FormFactorsRequest request;
};

/// Options that would do nothing together with others are refused.
void check(const CLI::App& command, const FormFactorsRequest& request) {
  const bool all = command.count("--all") > 0;
  for (const char* option : {"--from", "--to"}) {
    if (all && command.count(option) > 0) {
      throw UsageError(option, "has no effect with --all");
    }
    if (!all && command.count(option) == 0) {
      throw UsageError("formfactors", fmt::format("{} is required, or --all", option));
    }
  }
  if (all && command.count("--json") > 0) {
    throw UsageError("--json", "has no effect with --all, which prints CSV");
  }
  if (request.factors.method == NodeFactorMethod::rays && command.count("--accuracy") > 0) {
    throw UsageError("--accuracy", "has no effect with --method rays: choose --rays");
  }
  if (request.factors.method != NodeFactorMethod::rays && command.count("--rays") > 0) {
    throw UsageError("--rays", "has no effect without --method rays");
  }
}

void run(const CLI::App& command, FormFactorsOptions& options) {
  FormFactorsRequest& request = options.request;
  check(command, request);
  request.scene = options.common.scene;
  request.threads = options.common.settings.threads;
  request.factors.seed = options.common.settings.seed;
  Console console(options.common.verbosity);
  const std::string text = formfactors_run(request, console.events());
  std::cout << text << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
}

void add_method_options(CLI::App& command, NodeFactorSettings& settings) {
  const NodeFactorSettings standard;
  const auto add = [&](const std::string& option, const std::string& shown,
                       const std::string& description,
                       std::function<void(const std::string&)> take) {
    command.add_option_function<std::string>(option, take, description)->type_name(shown);
  };
  add("--method", fmt::format("{}", fmt::join(names_of(methods), "|")), "[analytic]",
      [&](const std::string& text) { settings.method = parse_choice("--method", text, methods); });
  add("--accuracy", "X",
      fmt::format("wanted relative error of the analytic method [{}]", standard.accuracy),
      [&](const std::string& text) {
        settings.accuracy = parse_number("--accuracy", text, Sign::positive);
      });
  add("--rays", "N", fmt::format("in all, with --method rays [{}]", standard.rays),
      [&](const std::string& text) {
        settings.rays = static_cast<int>(parse_integer("--rays", text, 16, 1 << 30));
      });
  add("--mirror-depth", "N", "the most mirrors a path may meet [as many as matter]",
      [&](const std::string& text) {
        settings.max_depth = static_cast<int>(parse_integer("--mirror-depth", text, 0, 1'000'000));
      });
}

} // namespace

Command add_formfactors_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "formfactors", "Print form factors between nodes, also through mirrors");
  const auto options = std::make_shared<FormFactorsOptions>();
  FormFactorsRequest& request = options->request;
  add_scene(*command, options->common);
  command->add_option("--from", request.from, "node whose front sends light")->type_name("NODE");
  command->add_option("--to", request.to, "node whose front receives it")->type_name("NODE");
  command->add_flag_callback(
      "--all", [=] { options->request.format = FormFactorsFormat::matrix; },
      "the matrix of all nodes as CSV, with row sums");
  command->add_flag_callback(
      "--json", [=] { options->request.format = FormFactorsFormat::json; },
      "as JSON instead of text");
  add_method_options(*command, request.factors);
  add_run_options(*command, options->common);
  return {command, [=] { run(*command, *options); }};
}

} // namespace meninas
