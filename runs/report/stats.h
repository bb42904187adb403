// The figures of a run, and their JSON (the keys are a promise to users;
// times in seconds, sizes in bytes).
// A figure that does not exist, such as an error bound without convergence, is null.
#pragma once

#include "raytrace/error/picture_error.h"
#include "raytrace/two_pass.h"
#include "reference/reference_picture.h"
#include "scenes/report/scene_report.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meninas {

struct RunSeconds {
  double load = 0.0, plan = 0.0, mesh = 0.0, form_factors = 0.0, solve = 0.0, interpolate = 0.0;
  double render = 0.0, estimate = 0.0, write = 0.0, total = 0.0;
};

struct RayCounts {
  std::uint64_t form_factor = 0, shadow = 0, camera = 0, specular = 0, path = 0;
};

/// The quality of a reference.
struct ReferenceFigures {
  int samples = 0;
  double standard_error = 0.0;
  reference::StoppedBy stopped_by = reference::StoppedBy::samples;
};

/// The outcome of the mirror worlds that were considered:
/// considered = kept + unseen + faint + beyond the limits.
struct WorldFigures {
  std::size_t considered = 0, kept = 0, pruned_unseen = 0, pruned_throughput = 0, pruned_limit = 0;
  double tail_bound = 0.0; ///< radiosity/scene/mirror_depth_bound.h
};

/// One try of a run that chose its own settings (steering.h).
struct SteeredStep {
  double wanted_elements = 0.0;
  std::size_t elements = 0; ///< there were
  int rays = 0, samples = 0;
  DiffuseTerm term = DiffuseTerm::interpolated;
  double seconds = 0.0;  ///< this step took
  double error = 0.0;    ///< estimated
  double foretold = 0.0; ///< before; 0 of the first
  std::string why;       ///< these settings
};
struct SteeredChoice {
  std::optional<double> wanted_error, wanted_seconds;
  std::vector<SteeredStep> steps;
  std::size_t kept = 0;             ///< which of them is the picture
  bool reached = false;             ///< what was wanted
  std::vector<std::string> options; ///< with which `render` makes the same picture
};

struct RunFigures {
  std::optional<ReferenceFigures>
      reference; ///< of a reference, which has no plan, mesh or solution
  std::size_t mirrors = 0, mirror_worlds = 0, emitters = 0;
  WorldFigures worlds;
  int bands = 1;
  std::size_t surfaces = 0, patches = 0, elements = 0, vertices = 0; ///< of the field
  std::size_t solved_elements = 0; ///< those pass one was solved for: fewer where it divided some
  SolverResult solver; ///< without its radiosity
  std::optional<LinkFigures> links; ///< of a hierarchical mesh
  EnergyBalance energy;
  ClosureError closure;
  std::optional<PictureError> error_estimate; ///< of the picture, relative
  std::optional<SteeredChoice> choice;
  RayCounts rays;
  RunSeconds seconds;
  std::uint64_t peak_memory_bytes = 0;
  int threads = 0;
  std::string closing; ///< what is known of the error, in words, for the run's last line
};

struct ExpectedCost; // expected_cost.h

/// Fills in what the prepared scene knows.
void add_preparation(RunFigures& figures, const PreparedScene& prepared);
/// Fills in what pass one has said about itself; its radiosities stay where they are.
void add_solution(RunFigures& figures, const RadiositySolution& solution);
void add_rendering(RunFigures& figures, const Rendering& rendering);
void add_reference(RunFigures& figures, const reference::ReferencePicture& picture);

/// "samples", "error" or "time"
const char* stop_name(reference::StoppedBy limit);

std::string stats_json(const RunFigures& figures);
/// W/m^2, and lux by so many lm/W.
std::string per_node_json(const std::vector<NodeLight>& nodes, double luminous_efficacy);
std::string plan_json(const TransportPlan& plan, const std::vector<std::string>& variants,
                      std::size_t patches, std::size_t elements, const ExpectedCost& expected, std::span<const Oddity> odd);

/// Writes the text whole or not at all.
void write_text_file(const std::filesystem::path& file, const std::string& text);

} // namespace meninas
