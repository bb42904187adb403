#include "cli/help/option_text.h"

#include "cli/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

namespace meninas {
namespace {

bool is_help(const OptionInfo& option) { return std::ranges::count(option.long_names, "help") > 0; }

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

} // namespace

std::string exit_codes_sentence() {
  std::string text;
  for (const auto& [code, meaning] : exit_code_meanings)
    text += fmt::format("{}{} {}", text.empty() ? "Exit codes: " : ", ", code, meaning);
  return text + '.';
}

bool is_placed(const OptionInfo& option) { return !option.place.empty(); }

std::vector<std::string> names_with_dashes(const OptionInfo& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.short_names)
    names.push_back('-' + name);
  for (const std::string& name : option.long_names)
    names.push_back("--" + name);
  return names;
}

std::string written(const OptionInfo& option) {
  if (is_placed(option))
    return option.place;
  const std::string text = fmt::format("{}", fmt::join(names_with_dashes(option), ", "));
  return option.takes_value == TakesValue::no ? text : text + ' ' + option.value;
}

int rank_of_group(const std::string& name) {
  constexpr std::array<std::string_view, 5> last{light_group, sky_group, file_group, run_group, study_group};
  const auto found = std::ranges::find(last, name);
  return found == last.end() ? 0 : 1 + static_cast<int>(found - last.begin());
}

OptionGroups groups_of(const Options& command) {
  OptionGroups groups;
  std::vector<OptionInfo> options = command.list();
  std::ranges::stable_partition(options, is_placed);
  std::ranges::stable_partition(options, std::not_fn(is_help));
  for (const OptionInfo& option : options) {
    auto group = std::ranges::find(groups, option.group, &OptionGroups::value_type::first);
    if (group == groups.end())
      group = groups.insert(groups.end(), {option.group, {}});
    group->second.push_back(option);
  }
  std::ranges::stable_sort(groups, {}, [](const auto& group) { return rank_of_group(group.first); });
  return groups;
}

std::string usage(const Options& command, const std::string& name) {
  std::string text = name;
  if (!command.commands().empty())
    text += " COMMAND";
  for (const OptionInfo& option : command.list())
    if (is_placed(option))
      text += ' ' + option.place;
  return text + " [options]";
}

std::pair<std::string, std::string> default_apart(const std::string& description) {
  const auto bracket = description.rfind('[');
  if (bracket == std::string::npos || !description.ends_with(']'))
    return {description, ""};
  return {trimmed(description.substr(0, bracket)),
          description.substr(bracket + 1, description.size() - bracket - 2)};
}

const Options& command_named(const Options& program, const std::string& name) {
  if (name.empty())
    return program;
  std::vector<std::string> known;
  for (const Options* command : program.commands()) {
    if (command->name() == name)
      return *command;
    known.push_back(command->name());
  }
  throw UsageError("", fmt::format("no command '{}'{}", name, hint_for(name, known)));
}

} // namespace meninas
