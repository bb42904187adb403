// `solve`: pass one alone, kept as a solution file, as figures per node and at points.
#pragma once

#include "radiosity/queries/point_light.h"
#include "radiosity/transport/factor_file.h"
#include "runs/points/point_sets.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"

#include <filesystem>
#include <optional>

namespace meninas {

struct SolveRequest {
  std::filesystem::path scene;
  std::filesystem::path solution; ///< .glb
  std::optional<std::filesystem::path> per_node;
  std::optional<std::filesystem::path> stats;
  std::optional<std::filesystem::path> factors; ///< written: the form factors, for later runs
  std::optional<std::filesystem::path> reuse;   ///< read: form factors of an earlier run
  std::optional<FactorPart> shard; ///< the rows of this part alone, into the folder `factors`; no solution
  bool join = false;               ///< with the rows of the folder `factors`
  PointRequest points;
  RunSettings settings;
};

/// Light at the points themselves, by eight times the rays of a vertex.
PointQuerySettings point_query_settings(const PassOneSettings& settings);

/// Writes all outputs, or throws a UserError before or after the work; what was written is whole.
RunFigures solve_run(const SolveRequest& request, const RunEvents& events = {});

} // namespace meninas
