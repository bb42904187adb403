// Settings as a user would write them on the command line.
#pragma once

#include "runs/run_settings.h"

#include <string>
#include <vector>

namespace meninas {

/// "draft"; "direct"; "hemicube"; ... as the options take them.
const char* name_of(Quality quality);
const char* name_of(DiffuseTerm term);
const char* name_of(FormFactorMethod method);
const char* name_of(Interpolation method);
const char* name_of(Projection projection);

/// {"--quality", "draft", "--rays", "64", ...}: what differs from the defaults,
/// of what makes a picture of the two passes. `render` with these options makes the same bits.
std::vector<std::string> options_of(const RunSettings& settings);

} // namespace meninas
