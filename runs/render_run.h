// `render`: from a scene file to pictures.
#pragma once

#include "runs/steering/error_report.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/run_settings.h"
#include "runs/snapshots.h"
#include "runs/report/stats.h"
#include "runs/steering/steering.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

struct RenderRequest {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> pictures;
  std::optional<std::filesystem::path> solution; ///< of an earlier solve: pass one is skipped
  std::optional<std::filesystem::path> stats;
  std::optional<SnapshotRequest> snapshots; ///< of the progressive solver
  WithErrorMap error_map = WithErrorMap::no;
  std::optional<Goal> goal; ///< the run chooses what the settings leave open
  std::optional<std::string> camera;
  std::optional<FreeCamera> place; ///< in place of the file's cameras
  std::optional<PictureSize> size;
  PictureSettings picture;
  RunSettings settings;
};

/// Writes all outputs, or throws a UserError before or after the work; what was written is whole.
RunFigures render_run(const RenderRequest& request, const RunEvents& events = {});

} // namespace meninas
