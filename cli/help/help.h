// The help pages: what `-h` prints on a terminal, and the same as docs/options.md.
// Both are made from the options themselves, so that no page says what the program does not do.
#pragma once

#include "cli/options.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meninas {

struct Example {
  std::string_view command; ///< as it is typed
  std::string_view does;
};

/// The examples of a command, for beginners first; those of the program itself without a name.
std::span<const Example> examples_of(std::string_view command);

/// The option as `-h` of the command shows it, a line of 80 columns; nothing where `--help-all` alone shows it.
std::optional<OptionInfo> in_brief(std::string_view command, OptionInfo option);

/// A paragraph about an option that is too long for a terminal, or nothing.
std::string_view details_of(std::string_view option);

enum class HelpExtent { what_matters, everything };

/// Columns of the terminal: COLUMNS, else those that standard output has, else 80.
int terminal_width();

/// The text that `-h` prints about the program or, if one was chosen, about a command, wrapped to a width.
std::string help_page(const Options& program, HelpExtent extent, int width);

/// All commands with all of their options, as Markdown.
std::string options_page(const Options& program);

} // namespace meninas
