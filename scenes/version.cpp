#include "scenes/version.h"

namespace meninas {

std::string_view program_version() { return MENINAS_VERSION; }

} // namespace meninas
