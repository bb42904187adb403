// `render`: from a scene file to pictures.
#pragma once

#include "runs/steering/error_report.h"
#include "runs/outputs.h"
#include "runs/preparation.h"
#include "runs/run_settings.h"
#include "runs/snapshots.h"
#include "runs/report/stats.h"
#include "runs/steering/steering.h"
#include "runs/view.h"

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

/// The picture of a scene that was loaded with these settings, and of what the request names to be read besides.
struct RequestedPicture {
  ViewPicture picture;
  PictureSize size;
  Camera camera;
};
RequestedPicture requested_picture(const RenderRequest& request, Scene scene, const RunEvents& events,
                                   RunFigures& figures);

/// The same of a solution that is there: pass two alone.
ViewPicture picture_of_solution(const RenderRequest& request, const LitScene& lit,
                                const Camera& camera, PictureSize size, const RunEvents& events,
                                RunFigures& figures);

/// Writes all outputs, or throws a UserError before or after the work; what was written is whole.
RunFigures render_run(const RenderRequest& request, const RunEvents& events = {});

} // namespace meninas
