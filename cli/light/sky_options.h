// Options that say what surrounds a scene: --background, --environment, --sky and what belongs to them.
#pragma once

#include "cli/options.h"
#include "runs/run_settings.h"

namespace meninas {

void add_sky_options(Options& command, RunSettings& settings);

} // namespace meninas
