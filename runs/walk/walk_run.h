// `walk`: pass one, or a solution of an earlier run, as a page to walk through.
#pragma once

#include "image/view_transform.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"

#include <filesystem>
#include <optional>

namespace meninas {

struct WalkRequest {
  std::filesystem::path scene;
  std::filesystem::path page;                    ///< .html
  std::optional<std::filesystem::path> solution; ///< of an earlier solve: pass one is skipped
  std::optional<double> exposure;                ///< stops; chosen for each camera otherwise
  ViewTransform transform = ViewTransform::neutral;
  RunSettings settings; ///< with lamps known apart, their factors are what the dimmers begin with
};

/// Writes the page, or throws a UserError before or after the work; what was written is whole.
RunFigures walk_run(const WalkRequest& request, const RunEvents& events = {});

} // namespace meninas
