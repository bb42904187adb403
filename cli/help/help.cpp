#include "cli/help/help.h"

#include "cli/help/option_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <vector>

namespace meninas {
namespace {

constexpr int text_column = 26; ///< where descriptions begin
constexpr int narrowest = 40, widest = 100;
/// The text in lines of at most `width` columns. The first follows what stands at `column` already.
std::string wrapped(const std::string& text, int column, int indent, int width) {
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;) {
    const int size = static_cast<int>(word.size());
    if (column > indent && column + 1 + size > width) {
      result += '\n' + std::string(static_cast<std::size_t>(indent), ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += size;
  }
  return result + '\n';
}

/// A name with what it means, in two columns.
std::string entry(const std::string& name, const std::string& meaning, int width) {
  const int indent = width < 60 ? 6 : text_column;
  std::string line = "  " + name;
  if (meaning.empty())
    return line + '\n';
  if (static_cast<int>(line.size()) + 2 > indent) {
    line += '\n' + std::string(static_cast<std::size_t>(indent), ' ');
  } else {
    line.resize(static_cast<std::size_t>(indent), ' ');
  }
  return line + wrapped(meaning, indent, indent, width);
}

std::string examples(std::string_view command, int width) {
  std::string text;
  for (const Example& example : examples_of(command)) {
    text += fmt::format("  {}\n", example.command);
    text += "      " + wrapped(std::string(example.does), 6, 6, width);
  }
  return text.empty() ? text : "\nExamples:\n" + text;
}

} // namespace

int terminal_width() {
  int columns = 0;
  winsize window{};
  if (const char* given = std::getenv("COLUMNS"))
    columns = std::atoi(given);
  if (columns <= 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0)
    columns = window.ws_col;
  return columns > 0 ? std::clamp(columns, narrowest, widest) : 80;
}

std::string help_page(const Options& program, HelpExtent extent, int width) {
  const Options* const chosen = program.chosen_command();
  const Options& command = chosen ? *chosen : program;
  const std::string short_name = chosen ? chosen->name() : "";
  const std::string name = chosen ? program.name() + ' ' + short_name : program.name();
  std::string text = wrapped(command.description() + '.', 0, 0, width);
  text += examples(short_name, width);
  text += "\nUsage: " + wrapped(usage(command, name), 7, 7, width);
  if (const auto commands = command.commands(); !commands.empty()) {
    text += "\nCommands:\n";
    for (const Options* one : commands)
      text += entry(one->name(), one->description(), width);
  }
  bool complete = true;
  for (const auto& [group, options] : groups_of(command)) {
    std::string lines;
    for (const OptionInfo& option : options) {
      const auto shown = extent == HelpExtent::everything ? std::optional(option) : in_brief(short_name, option);
      complete = complete && shown;
      if (shown)
        lines += entry(written(*shown), shown->description, width);
    }
    text += lines.empty() ? "" : fmt::format("\n{}:\n{}", group, lines);
  }
  if (!complete)
    text += '\n' + wrapped(fmt::format("{} --help-all lists all options.", name), 0, 0, width);
  return text + '\n' + wrapped(exit_codes_sentence(), 0, 0, width);
}

namespace {

/// A line of a table, with what would end a cell escaped.
std::string table_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find_first_of("|<", at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

std::string table_row(const OptionInfo& option) {
  const auto [meaning, standard] = default_apart(option.description);
  return fmt::format("| `{}` | {} | {} |\n", table_cell(written(option)), table_cell(meaning),
                     table_cell(standard));
}

/// The same option, as several commands have it.
struct SharedOption {
  OptionInfo option;
  std::vector<std::string> commands;
};

bool is_same(const OptionInfo& a, const OptionInfo& b) {
  return written(a) == written(b) && a.description == b.description;
}

std::vector<SharedOption> shared_options(const Options& program) {
  std::vector<SharedOption> options;
  for (const Options* command : program.commands())
    for (const OptionInfo& option : command->list()) {
      if (is_placed(option))
        continue;
      const auto known = std::ranges::find_if(
          options, [&](const SharedOption& one) { return is_same(one.option, option); });
      if (known == options.end())
        options.push_back({option, {command->name()}});
      else
        known->commands.push_back(command->name());
    }
  std::erase_if(options, [](const SharedOption& one) { return one.commands.size() < 2; });
  return options;
}

constexpr const char* table_head = "\n| option | | default |\n|---|---|---|\n";

/// The paragraphs about these options, each named, unless they have been `told` before.
std::string notes(const std::vector<OptionInfo>& options, std::set<std::string>& told) {
  std::string text;
  for (const OptionInfo& option : options) {
    if (option.long_names.empty())
      continue;
    const std::string name = "--" + option.long_names.front();
    const std::string_view details = details_of(name);
    if (!details.empty() && told.insert(name).second)
      text += fmt::format("\n`{}`: {}\n", name, details);
  }
  return text;
}

std::string command_section(const Options& command, const std::vector<SharedOption>& shared,
                            std::set<std::string>& told) {
  std::string text =
      fmt::format("\n## meninas {}\n\n{}.\n\n```\n{}\n```\n", command.name(), command.description(),
                  usage(command, "meninas " + command.name()));
  text += examples_of(command.name()).empty() ? "" : "\n";
  for (const Example& example : examples_of(command.name()))
    text += fmt::format("- `{}`: {}\n", example.command, example.does);
  std::string rows;
  std::vector<OptionInfo> own;
  for (const OptionInfo& option : command.list()) {
    const bool elsewhere = std::ranges::any_of(
        shared, [&](const SharedOption& one) { return is_same(one.option, option); });
    if (!elsewhere) {
      rows += table_row(option);
      own.push_back(option);
    }
  }
  return text + (rows.empty() ? "" : table_head + rows) + notes(own, told);
}

} // namespace

std::string options_page(const Options& program) {
  std::string text = "# Options\n\n`meninas help --markdown` prints this page; `meninas COMMAND "
                     "--help-all` prints a command's part of it. Options that several commands\n"
                     "have stand at the end.\n";
  const auto shared = shared_options(program);
  std::set<std::string> told;
  for (const Options* command : program.commands())
    text += command_section(*command, shared, told);
  text += "\n# Options of several commands\n";
  std::vector<std::string> groups;
  for (const SharedOption& one : shared)
    if (std::ranges::find(groups, one.option.group) == groups.end())
      groups.push_back(one.option.group);
  std::ranges::stable_sort(groups, {}, rank_of_group);
  for (const std::string& group : groups) {
    text += fmt::format("\n## {}\n\n| option | | default | commands |\n|---|---|---|---|\n", group);
    std::vector<OptionInfo> options;
    for (const SharedOption& one : shared) {
      if (one.option.group != group)
        continue;
      const bool all = one.commands.size() == program.commands().size();
      std::string row = table_row(one.option);
      row.pop_back();
      text += fmt::format("{} {} |\n", row, all ? "all" : fmt::format("{}", fmt::join(one.commands, ", ")));
      options.push_back(one.option);
    }
    text += notes(options, told);
  }
  return text + "\n" + exit_codes_sentence() + "\n";
}

} // namespace meninas
