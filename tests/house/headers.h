// Whether public headers of the method say what they compute.
//
// Headers of mirror, form_factors, radiosity and raytrace open with a comment of at least 12 words;
// where they declare functions that return quantities, their comments have an equation, a year of
// the literature, or a unit.
#pragma once

#include "tests/house/source_tree.h"

namespace meninas {

/// One line for each breach, `PATH:LINE: WHAT`.
std::vector<std::string> header_breaches(const std::vector<SourceFile>& tree);

} // namespace meninas
