// `bake`: pass one, or a solution of an earlier run, as lightmaps in the scene's own file.
#pragma once

#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/stats.h"

#include <filesystem>
#include <optional>

namespace meninas {

struct BakeRequest {
  std::filesystem::path scene;
  std::filesystem::path baked; ///< .glb; NAME.lightmap.exr and NAME.lightmap.png are written beside it
  std::optional<std::filesystem::path> solution; ///< of an earlier solve: pass one is skipped
  int lightmap_size = 2048;                      ///< texels a side, at most
  bool direct = true; ///< else indirect irradiance alone (IrradianceField::indirect)
  RunSettings settings;
};
inline constexpr int min_lightmap = 16, largest_lightmap = 16384;

/// Writes the three files, or throws a UserError before or after the work; what was written is whole.
RunFigures bake_run(const BakeRequest& request, const RunEvents& events = {});

} // namespace meninas
