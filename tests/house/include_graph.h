// The order inside the house: which chapter of radiosity/ may include which, that no header-and-source
// pair leads back to itself, and how many pairs a folder has.
//
// A pair is a path without its extension: `mirror/worlds.h` and `mirror/worlds.cpp` are one.
#pragma once

#include "tests/house/source_tree.h"

namespace meninas {

/// Includes from a chapter of radiosity/ to one that comes after it.
std::vector<std::string> chapter_breaches(const std::vector<SourceFile>& tree);

/// Pairs that include one another in a circle, a line for each circle.
std::vector<std::string> knots(const std::vector<SourceFile>& tree);

/// Folders of more than twenty pairs.
std::vector<std::string> crowded_folders(const std::vector<SourceFile>& tree);

} // namespace meninas
