#include "cli/help.h"

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

/// "-o, --output FILE"
std::string written(const CLI::Option& option) {
  if (option.get_positional())
    return option.get_name(true);
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames())
    names.push_back('-' + name);
  for (const std::string& name : option.get_lnames())
    names.push_back("--" + name);
  std::string text = fmt::format("{}", fmt::join(names, ", "));
  return option.get_expected_max() == 0 ? text : text + ' ' + option.get_type_name();
}

/// Options by group, in the order in which they were added: the scene first, help last.
using OptionGroups = std::vector<std::pair<std::string, std::vector<const CLI::Option*>>>;

OptionGroups groups_of(const CLI::App& app) {
  OptionGroups groups;
  std::vector<const CLI::Option*> options = app.get_options();
  std::ranges::stable_partition(options, [](const CLI::Option* o) { return o->get_positional(); });
  std::ranges::stable_partition(options, [&](const CLI::Option* o) { return o != app.get_help_ptr(); });
  for (const CLI::Option* option : options) {
    const std::string& name = option->get_group();
    auto group = std::ranges::find(groups, name, &OptionGroups::value_type::first);
    if (group == groups.end())
      group = groups.insert(groups.end(), {name, {}});
    group->second.push_back(option);
  }
  return groups;
}

std::string examples(std::string_view command, int width) {
  std::string text;
  for (const Example& example : examples_of(command)) {
    text += fmt::format("  {}\n", example.command);
    text += "      " + wrapped(std::string(example.does), 6, 6, width);
  }
  return text.empty() ? text : "\nExamples:\n" + text;
}

std::string usage(const CLI::App& app, const std::string& name) {
  std::string text = name;
  if (!app.get_subcommands({}).empty())
    text += " COMMAND";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      text += ' ' + option->get_name(true);
  return text + " [options]";
}

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
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

std::string HelpPage::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const {
  const std::string command = app->get_parent() == nullptr ? "" : app->get_name();
  name = trimmed(name);
  std::string text = wrapped(app->get_description() + '.', 0, 0, width_);
  text += examples(command, width_);
  text += "\nUsage: " + wrapped(usage(*app, name), 7, 7, width_);
  if (const auto commands = app->get_subcommands({}); !commands.empty()) {
    text += "\nCommands:\n";
    for (const CLI::App* one : commands)
      text += entry(one->get_name(), one->get_description(), width_);
  }
  bool complete = true;
  for (const auto& [group, options] : groups_of(*app)) {
    std::string lines;
    for (const CLI::Option* option : options) {
      const bool shown = extent_ == HelpExtent::everything || matters_most(command, *option);
      complete = complete && shown;
      if (shown)
        lines += entry(written(*option), option->get_description(), width_);
    }
    text += lines.empty() ? "" : fmt::format("\n{}:\n{}", group, lines);
  }
  if (!complete)
    text += '\n' + wrapped(fmt::format("{} --help-all lists all options.", name), 0, 0, width_);
  const std::string footer = app->get_footer();
  return footer.empty() ? text : text + '\n' + wrapped(footer, 0, 0, width_);
}

namespace {

/// A line of a table, with what would end a cell escaped.
std::string table_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find_first_of("|<", at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

/// A description apart from the default that it ends with, in brackets.
std::pair<std::string, std::string> default_apart(const std::string& description) {
  const auto bracket = description.rfind('[');
  if (bracket == std::string::npos || !description.ends_with(']'))
    return {description, ""};
  return {trimmed(description.substr(0, bracket)),
          description.substr(bracket + 1, description.size() - bracket - 2)};
}

std::string table_row(const CLI::Option& option) {
  const auto [meaning, standard] = default_apart(option.get_description());
  return fmt::format("| `{}` | {} | {} |\n", table_cell(written(option)), table_cell(meaning),
                     table_cell(standard));
}

/// The same option, as several commands have it.
struct SharedOption {
  const CLI::Option* option;
  std::vector<std::string> commands;
};

bool is_same(const CLI::Option& a, const CLI::Option& b) {
  return written(a) == written(b) && a.get_description() == b.get_description();
}

std::vector<SharedOption> shared_options(const CLI::App& program) {
  std::vector<SharedOption> options;
  for (const CLI::App* command : program.get_subcommands({}))
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_positional())
        continue;
      const auto known = std::ranges::find_if(
          options, [&](const SharedOption& one) { return is_same(*one.option, *option); });
      if (known == options.end())
        options.push_back({option, {command->get_name()}});
      else
        known->commands.push_back(command->get_name());
    }
  std::erase_if(options, [](const SharedOption& one) { return one.commands.size() < 2; });
  return options;
}

constexpr const char* table_head = "\n| option | | default |\n|---|---|---|\n";

/// The paragraphs about these options, each named, unless they have been `told` before.
std::string notes(const std::vector<const CLI::Option*>& options, std::set<std::string>& told) {
  std::string text;
  for (const CLI::Option* option : options) {
    if (option->get_lnames().empty())
      continue;
    const std::string name = "--" + option->get_lnames().front();
    const std::string_view details = details_of(name);
    if (!details.empty() && told.insert(name).second)
      text += fmt::format("\n`{}`: {}\n", name, details);
  }
  return text;
}

std::string command_section(const CLI::App& command, const std::vector<SharedOption>& shared,
                            std::set<std::string>& told) {
  std::string text = fmt::format("\n## meninas {}\n\n{}.\n\n```\n{}\n```\n", command.get_name(),
                                 command.get_description(),
                                 usage(command, "meninas " + command.get_name()));
  text += examples_of(command.get_name()).empty() ? "" : "\n";
  for (const Example& example : examples_of(command.get_name()))
    text += fmt::format("- `{}`: {}\n", example.command, example.does);
  std::string rows;
  std::vector<const CLI::Option*> own;
  for (const CLI::Option* option : command.get_options()) {
    const bool elsewhere = std::ranges::any_of(
        shared, [&](const SharedOption& one) { return is_same(*one.option, *option); });
    if (!elsewhere) {
      rows += table_row(*option);
      own.push_back(option);
    }
  }
  return text + (rows.empty() ? "" : table_head + rows) + notes(own, told);
}

} // namespace

std::string options_page(const CLI::App& program) {
  std::string text = "# Options\n\n`meninas help --markdown` prints this page; `meninas COMMAND "
                     "--help-all` prints a command's part of it. Options that several commands\n"
                     "have stand at the end.\n";
  const auto shared = shared_options(program);
  std::set<std::string> told;
  for (const CLI::App* command : program.get_subcommands({}))
    text += command_section(*command, shared, told);
  text += "\n# Options of several commands\n";
  std::vector<std::string> groups;
  for (const SharedOption& one : shared)
    if (std::ranges::find(groups, one.option->get_group()) == groups.end())
      groups.push_back(one.option->get_group());
  for (const std::string& group : groups) {
    text += fmt::format("\n## {}\n\n| option | | default | commands |\n|---|---|---|---|\n", group);
    std::vector<const CLI::Option*> options;
    for (const SharedOption& one : shared) {
      if (one.option->get_group() != group)
        continue;
      const bool all = one.commands.size() == program.get_subcommands({}).size();
      std::string row = table_row(*one.option);
      row.pop_back();
      text += fmt::format("{} {} |\n", row, all ? "all" : fmt::format("{}", fmt::join(one.commands, ", ")));
      options.push_back(one.option);
    }
    text += notes(options, told);
  }
  return text + "\n" + program.get_footer() + "\n";
}

} // namespace meninas
