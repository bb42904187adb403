// The origin of the reference pictures of a folder: manifest.json beside them, one entry per file.
#pragma once

#include "runs/json/cases_file.h"

#include <filesystem>

namespace meninas {

/// Enters {"case", "scene", "scene_hash", "command", "samples", "standard_error",
/// "program", "date"} for the case's reference, which has just been written;
/// entries of other files stay. Values that the picture's header does not have are null.
void enter_reference(const RegressCase& regress_case, const std::filesystem::path& cases_file);

} // namespace meninas
