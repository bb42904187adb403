// Where the checkout is that the tests were built from.
#pragma once

#include <string>

namespace meninas::test {

std::string source_dir();

} // namespace meninas::test
