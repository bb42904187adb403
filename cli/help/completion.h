// Shell completion of command lines: commands, options, choices and files, as a script for bash, zsh or fish.
#pragma once

#include "cli/options.h"

#include <string>

namespace meninas {

/// The script of a shell, "bash", "zsh" or "fish"; throws UsageError for another.
std::string completion_script(const Options& program, const std::string& shell);

} // namespace meninas
