// Settings from elsewhere than the command line, such as the cases of `regress`: the same
// options with the same values, read by the very definitions that read them on the command line.
#pragma once

#include "runs/steering/setting.h"

namespace meninas {

/// The request of `meninas render SCENE` with these options;
/// outputs, threads and verbosity are not settings.
/// Throws UsageError "NAME: WHAT" without dashes;
/// unknown names get the nearest known one as a hint.
RenderRequest parse_render_settings(const std::filesystem::path& scene,
                                    const std::vector<Setting>& settings);

/// The options that may be settings.
std::vector<SettingHelp> render_settings_help();

} // namespace meninas
