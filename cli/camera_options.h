// Options for a camera that the file does not have.
#pragma once

#include "cli/options.h"
#include "runs/preparation.h"

#include <optional>

namespace meninas {

/// `--eye X,Y,Z --target X,Y,Z --angle DEGREES`.
void add_free_camera(Options& command, std::optional<FreeCamera>& place);

/// Throws UsageError where one of them is missing, or there is nothing to be seen by them.
void check_free_camera(const Options& command, const std::optional<FreeCamera>& place,
                       const RunSettings& settings);

} // namespace meninas
