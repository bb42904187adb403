// Manual pages, as man(1) shows them: made from the options, examples and paragraphs of the help pages.
// The macros are those of man(7); groff and mandoc read them without a warning.
#pragma once

#include "cli/options.h"

#include <string>

namespace meninas {

/// meninas(1) without a name, meninas-COMMAND(1) with one; throws UsageError where there is no such command.
std::string manual_page(const Options& program, const std::string& command);

} // namespace meninas
