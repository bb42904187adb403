#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/values.h"
#include "runs/diff_run.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

namespace meninas {
namespace {

struct DiffOptions {
  DiffRequest request;
  Verbosity verbosity = Verbosity::normal;
};

struct LimitOption {
  const char* option;
  Metric metric;
  const char* description;
};
constexpr LimitOption limit_options[] = {
    {"--max-rmse", Metric::rmse, "root of the mean squared difference"},
    {"--max-relmse", Metric::relmse, "mean of (a - b)^2 / (b^2 + epsilon)"},
    {"--max-mae", Metric::mae, "mean absolute difference"},
    {"--max-abs", Metric::max_abs, "largest difference of any channel of any pixel"},
    {"--min-psnr", Metric::psnr, "decibels"},
    {"--min-ssim", Metric::ssim, "structural similarity, 1 for identical pictures"},
    {"--max-flip", Metric::flip, "mean visible difference when flipping between both, 0 to 1"}};

Choices<Metric> metric_choices() {
  Choices<Metric> choices;
  for (const Metric metric : all_metrics) {
    if (metric != Metric::psnr) {
      choices.emplace_back(name_of(metric), metric);
    }
  }
  return choices;
}

void run(DiffOptions& options) {
  Console console(options.verbosity);
  const DiffResult result = diff_run(options.request, console.events());
  std::cout << result.text << std::flush;
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
  if (!result.broken.empty()) {
    throw UserError(ExitCode::out_of_tolerance, options.request.picture.string(), "",
                    fmt::format("{}", fmt::join(result.broken, ", ")));
  }
}

void add_limits(Options& command, DiffRequest& request) {
  for (const LimitOption& limit : limit_options) {
    const std::string name = limit.option;
    const Metric metric = limit.metric;
    command
        .add(name, "X", limit.description,
             [&request, name, metric](const std::string& text) {
               request.limits.push_back({metric, parse_number(name, text, Sign::any)});
             })
        .group("Limits (exit code 1 beyond one)");
  }
}

void add_picture_options(Options& command, DiffRequest& request) {
  command.add("--layer", "NAME", "compare this layer of both EXRs",
              [&](const std::string& text) { request.layer = text; });
  command.add("--heat", fmt::format("{}", fmt::join(names_of(metric_choices()), "|")),
              "error that the heat map shows [flip]", [&](const std::string& text) {
                request.heat_metric = parse_choice("--heat", text, metric_choices());
              });
  command.add("--exposure", "EV", "exposure at which ssim and flip compare EXRs [automatic, for B]",
              [&](const std::string& text) {
                request.exposure = parse_number("--exposure", text, Sign::any);
              });
  command.add(
      "--relmse-epsilon", "X",
      fmt::format("epsilon of relmse, in units of radiance squared [{}]", request.relmse_epsilon),
      [&](const std::string& text) {
        request.relmse_epsilon = parse_number("--relmse-epsilon", text, Sign::positive);
      });
}

} // namespace

Command add_diff_command(Options& program) {
  Options& command = program.add_command("diff", "Measure how far a picture is from a reference");
  const auto options = std::make_shared<DiffOptions>();
  DiffRequest& request = options->request;
  command
      .add("A", "", "picture: EXR, TIFF, HDR, PNG or JPEG",
           [=](const std::string& text) { options->request.picture = text; })
      .required();
  command
      .add("B", "", "reference picture",
           [=](const std::string& text) { options->request.reference = text; })
      .required();
  add_file(command, "-o,--output", request.heat_map, "heat map of the errors, .png");
  add_picture_options(command, request);
  add_limits(command, request);
  command.add_flag("--json", "print JSON", [=] { options->request.format = DiffFormat::json; });
  return {&command, [=] { run(*options); }};
}

} // namespace meninas
