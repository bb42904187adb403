// Settings of a picture that come from a file: options of `meninas render` by their names.
#pragma once

#include "runs/render_run.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// An option by its name without dashes; no value for a flag.
struct Setting {
  std::string name;
  std::optional<std::string> value;
  bool operator==(const Setting&) const = default;
};

/// An option that may be a setting, as its help says it.
struct SettingHelp {
  std::string name, description;
  std::string takes; ///< what its value looks like, or names joined by '|'; empty for a flag
  bool repeatable = false;
};

/// Puts settings into a request. Throws UsageError, `NAME: WHAT` where one setting is to blame.
/// The command line's own parser is one.
using SettingsParser =
    std::function<RenderRequest(const std::filesystem::path& scene, const std::vector<Setting>&)>;

} // namespace meninas
