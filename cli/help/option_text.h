// The spelling of commands and options, common to the terminal, docs/options.md, the manual pages and the
// completions of shells.
#pragma once

#include "cli/options.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace meninas {

struct ExitCodeMeaning {
  int code;
  const char* meaning;
};

inline constexpr std::array exit_code_meanings{
    ExitCodeMeaning{1, "a comparison beyond its limits"}, ExitCodeMeaning{2, "wrong usage"},
    ExitCodeMeaning{3, "bad input"}, ExitCodeMeaning{4, "failed write or exhausted resource"}};

/// "Exit codes: 1 a comparison beyond its limits, 2 ..."
std::string exit_codes_sentence();

/// Whether it is an argument that is known by its place.
bool is_placed(const OptionInfo& option);

/// "-o" and "--output", short ones first.
std::vector<std::string> names_with_dashes(const OptionInfo& option);

/// "-o, --output FILE"
std::string written(const OptionInfo& option);

/// By which groups are sorted: 0 a command's own, then those of many commands.
int rank_of_group(const std::string& name);

/// Options by group, in the order in which they were added, of many commands last: the scene first, help last.
using OptionGroups = std::vector<std::pair<std::string, std::vector<OptionInfo>>>;
OptionGroups groups_of(const Options& command);

/// "meninas render SCENE [options]", with `name` for the first words.
std::string usage(const Options& command, const std::string& name);

/// A description apart from the default that it ends with, in brackets.
std::pair<std::string, std::string> default_apart(const std::string& description);

/// The program itself without a name, else its command; throws UsageError, with the nearest name, where there is none.
const Options& command_named(const Options& program, const std::string& name);

} // namespace meninas
