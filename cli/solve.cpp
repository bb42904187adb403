#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/light/lamp_options.h"
#include "cli/pixel_options.h"
#include "cli/values.h"
#include "runs/solve_run.h"
#include "scenes/errors.h"

namespace meninas {
namespace {

struct SolveOptions {
  CommonOptions common;
  SolveRequest request;
};

constexpr const char* points_group = "Numbers at points";

void add_point_options(Options& command, PointRequest& request) {
  const auto add_length = [&](const char* option, const char* description, double& length) {
    command
        .add(option, "METRES", description,
             [&length, option](const std::string& text) {
               length = parse_number(option, text, Sign::any);
               if (length < 0.0)
                 throw UsageError(option, "cannot be negative");
             })
        .group(points_group);
  };
  add_file(command, "--points", request.points,
           "report the light at the points of a .csv: x,y,z and the normal nx,ny,nz")
      .group(points_group);
  command
      .add_repeatable("--grid", "NODE",
                      "report the light on a grid over each face of a node, spaced as EN 12464-1 "
                      "says; may be given several times",
                      [&](const std::string& text) { request.grids.push_back(text); })
      .group(points_group);
  add_length("--grid-margin", "--grid: leave out a margin along the face's outline [0]",
             request.grid.margin);
  add_length("--grid-height", "--grid: put the points so high above the face [0]",
             request.grid.height);
  add_file(command, "--points-out", request.out,
           "table of --points and --grid, .csv or .json [SOLUTION.points.csv]")
      .group(points_group);
}

void check_point_options(const Options& command, const PointRequest& request) {
  if (request.grids.empty())
    refuse(command, {"--grid-margin", "--grid-height"}, "has no effect without --grid");
  if (!request.asks())
    refuse(command, {"--points-out"}, "has no effect without --points or --grid");
}

/// One solve on many machines: rows by --shard, then the rest by --join.
void check_parts(const Options& command, const SolveRequest& request) {
  if (request.shard) {
    refuse(command,
           {"--output", "--per-node", "--stats", "--reuse", "--join", "--points", "--grid", "--by-lamp"},
           "does not go with --shard, which writes rows alone");
  } else if (request.solution.empty()) {
    throw UsageError("solve", "--output is required");
  }
  if ((request.shard || request.join) && !request.factors)
    throw UsageError(request.shard ? "--shard" : "--join", "needs the folder of the rows: --factors DIR");
  if (request.join)
    refuse(command, {"--reuse"}, "does not go with --join");
}

void run(const Options& command, SolveOptions& options) {
  check_parts(command, options.request);
  check_pass_one_options(command, options.common.settings);
  check_point_options(command, options.request.points);
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
  command.add("-o,--output", "FILE", "solution, .glb; any glTF viewer shows it",
              [=](const std::string& text) { options->request.solution = text; });
  add_file(command, "--per-node", options->request.per_node,
           "write area, emission, radiosity, irradiance and illuminance of each glTF node as JSON");
  add_file(command, "--stats", options->request.stats, "write the figures of the run as JSON");
  add_file(command, "--factors", options->request.factors, "write the form factors for later runs");
  command.add("--shard", "K/N",
              "write only part K of N of the rows, such as 1/4, into the folder --factors",
              [=](const std::string& text) {
                const PicturePart part = parse_part("--shard", text);
                options->request.shard = FactorPart{static_cast<std::uint64_t>(part.number),
                                                    static_cast<std::uint64_t>(part.count)};
              });
  command.add_flag("--join", "solve with the rows that --shard wrote into the folder --factors",
                   [=] { options->request.join = true; });
  add_file(command, "--reuse", options->request.reuse,
           "use the form factors of an earlier run; only emission and diffuse reflectances may "
           "have changed");
  add_by_lamp(command,
              "find the light of each lamp apart, so that `render --lamp` and the dimmers of `walk` "
              "change it without solving [by node]",
              options->common.settings.lamps);
  add_point_options(command, options->request.points);
  add_solve_options(command, options->common);
  return {&command, [=, &command] { run(command, *options); }};
}

} // namespace meninas
