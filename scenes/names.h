// Names in messages: those a user may have mistyped, and lists of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meninas {

/// The known name that is nearest to `name` by edit distance, case aside; nothing when none is
/// near.
std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> known);

/// "no camera 'x', did you mean 'y'?", or how many there are and the first of them.
std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string> known);

/// 'A', 'B' and 3 more: each name once, the first six of them.
std::string quoted_names(std::span<const std::string> names);

} // namespace meninas
