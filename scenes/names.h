// Names a user may have mistyped.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meninas {

/// The known name that is nearest to `name` by edit distance, case aside; nothing when none is
/// near.
std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> known);

} // namespace meninas
