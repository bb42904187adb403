// How far a long computation is.
#pragma once

#include <functional>
#include <string_view>

namespace meninas {

/// Called with the stage's name and the fraction of it that is done, from any thread;
/// may be empty. Never affects the result.
using Progress = std::function<void(std::string_view stage, double fraction)>;

} // namespace meninas
