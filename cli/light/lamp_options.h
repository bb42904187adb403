// Options about the lamps of a scene.
#pragma once

#include "cli/options.h"
#include "scenes/lamps.h"

#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// `--lamp NAME=FACTOR|R,G,B`, several times, or several joined by semicolons as in the settings of a batch.
void add_lamp_factors(Options& command, const std::string& description,
                      std::vector<LampFactor>& lamps);

/// `node` or `material`; throws UsageError that names the option. `preset_value` and nothing are `node`.
LampGrouping parse_lamp_grouping(const std::string& option, const std::string& text);

/// `--by-lamp [node|material]`.
void add_by_lamp(Options& command, const std::string& description,
                 std::optional<LampGrouping>& grouping);

} // namespace meninas
