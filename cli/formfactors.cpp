#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/formfactors_run.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iostream>

namespace meninas {
namespace {

const Choices<NodeFactorMethod> methods{{"analytic", NodeFactorMethod::analytic},
                                        {"rays", NodeFactorMethod::rays},
                                        {"hemicube", NodeFactorMethod::hemicube}};

const Choices<NodeSides> side_choices{{"facing", NodeSides::facing},
                                      {"front", NodeSides::front},
                                      {"back", NodeSides::back},
                                      {"both", NodeSides::both}};

struct FormFactorsOptions {
  CommonOptions common;
  FormFactorsRequest request;
};

/// Which method an option belongs to.
struct MethodOption {
  const char* option;
  NodeFactorMethod method;
};
constexpr std::array method_options{MethodOption{"--accuracy", NodeFactorMethod::analytic},
                                    MethodOption{"--rays", NodeFactorMethod::rays},
                                    MethodOption{"--resolution", NodeFactorMethod::hemicube},
                                    MethodOption{"--points", NodeFactorMethod::hemicube}};

void refuse_options_of_other_methods(const Options& command, NodeFactorMethod method) {
  for (const MethodOption& given : method_options) {
    if (given.method != method && command.given(given.option)) {
      throw UsageError(given.option, fmt::format("has no effect without --method {}",
                                                 name_of(given.method, methods)));
    }
  }
}

/// Options that would do nothing together with others are refused.
void check(const Options& command, const FormFactorsRequest& request) {
  const bool all = command.given("--all");
  for (const char* option : {"--from", "--to"}) {
    if (all && command.given(option)) {
      throw UsageError(option, "has no effect with --all");
    }
    if (!all && !command.given(option)) {
      throw UsageError("formfactors", fmt::format("{} is required, or --all", option));
    }
  }
  if (all && command.given("--json")) {
    throw UsageError("--json", "has no effect with --all, which prints CSV");
  }
  refuse_options_of_other_methods(command, request.factors.method);
}

void run(const Options& command, FormFactorsOptions& options) {
  FormFactorsRequest& request = options.request;
  check(command, request);
  request.scene = options.common.scene;
  request.gltf = options.common.settings.gltf;
  request.threads = options.common.settings.threads;
  request.factors.seed = options.common.settings.seed;
  Console console(options.common.verbosity);
  const std::string text = formfactors_run(request, console.events());
  std::cout << text << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
}

void add_method_options(Options& command, NodeFactorSettings& settings) {
  const NodeFactorSettings standard;
  command.add("--method", fmt::format("{}", fmt::join(names_of(methods), "|")),
              "how form factors are computed [analytic]", [&](const std::string& text) {
                settings.method = parse_choice("--method", text, methods);
              });
  command.add(
      "--sides", fmt::format("{}", fmt::join(names_of(side_choices), "|")),
      "sides of double-sided nodes that count; facing: those that see the other node [facing]",
      [&](const std::string& text) {
        settings.sides = parse_choice("--sides", text, side_choices);
      });
  command.add("--accuracy", "X",
              fmt::format("--method analytic: relative error allowed [{}]", standard.accuracy),
              [&](const std::string& text) {
                settings.accuracy = parse_number("--accuracy", text, Sign::positive);
              });
  command.add("--rays", "N", fmt::format("--method rays: number of rays [{}]", standard.rays),
              [&](const std::string& text) {
                settings.rays = static_cast<int>(parse_integer("--rays", text, 16, 1 << 30));
              });
  command.add(
      "--resolution", "N",
      fmt::format("--method hemicube: cells along an edge of the top face, an even number [{}]",
                  standard.resolution),
      [&](const std::string& text) {
        settings.resolution = parse_resolution("--resolution", text);
      });
  command.add("--points", "N",
              fmt::format("--method hemicube: number of hemicubes over the sender, about [{}]",
                          standard.points),
              [&](const std::string& text) {
                settings.points = static_cast<int>(parse_integer("--points", text, 1, 1 << 20));
              });
  command.add("--mirror-depth", "N", "follow light over at most N mirrors [as many as matter]",
              [&](const std::string& text) {
                settings.max_depth =
                    static_cast<int>(parse_integer("--mirror-depth", text, 0, 1'000'000));
              });
}

} // namespace

Command add_formfactors_command(Options& program) {
  Options& command =
      program.add_command("formfactors", "Print form factors between nodes, also through mirrors");
  const auto options = std::make_shared<FormFactorsOptions>();
  FormFactorsRequest& request = options->request;
  add_scene(command, options->common);
  command.add("--from", "NODE", "node or group of nodes that sends light",
              [=](const std::string& text) { options->request.from = text; });
  command.add("--to", "NODE", "node or group of nodes that receives it",
              [=](const std::string& text) { options->request.to = text; });
  command.add_flag("--all", "print the matrix of all nodes as CSV, with row sums",
                   [=] { options->request.format = FormFactorsFormat::matrix; });
  command.add_flag("--json", "print JSON",
                   [=] { options->request.format = FormFactorsFormat::json; });
  add_state_options(command, options->common);
  add_method_options(command, request.factors);
  add_run_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
