#include "tests/support/source_dir.h"

namespace meninas::test {

std::string source_dir() { return MENINAS_SOURCE_DIR; }

} // namespace meninas::test
