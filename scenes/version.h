// The program's version, as the build was configured.
#pragma once

#include <string_view>

namespace meninas {

/// "1.2.3"
std::string_view program_version();

} // namespace meninas
