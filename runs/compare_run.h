// `compare`: one view in every mode from one solve,
// with what the modes differ in, as files and as one page.
#pragma once

#include "image/view_transform.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"

#include <filesystem>
#include <optional>
#include <string>

namespace meninas {

enum class WithReference { no, yes };

struct CompareRequest {
  std::filesystem::path scene;
  std::filesystem::path folder; ///< made if it is not there
  std::optional<std::string> camera;
  std::optional<PictureSize> size;
  std::optional<double> exposure; ///< stops; automatic for the most accurate picture
  ViewTransform transform = ViewTransform::neutral; ///< of all PNGs and of the page
  WithReference reference = WithReference::no;
  RunSettings settings; ///< its mode is not heeded
};

/// Writes, for every mode, ID.exr and ID.png (hybrid.exr with its nine layers),
/// ID-minus-ID.png for neighbouring modes, figures.json, and index.html last.
/// Throws a UserError; every file that is there is whole.
void compare_run(const CompareRequest& request, const RunEvents& events = {});

} // namespace meninas
