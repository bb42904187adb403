// The help pages: what `-h` prints on a terminal, and the same as docs/options.md.
// Both are made from the options themselves, so that no page says what the program does not do.
#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <string_view>

namespace meninas {

struct Example {
  std::string_view command; ///< as it is typed
  std::string_view does;
};

/// The examples of a command, for beginners first. Of the program itself without a name.
std::span<const Example> examples_of(std::string_view command);

/// Whether `-h` of the command shows the option; `--help-all` shows all of them.
bool matters_most(std::string_view command, const CLI::Option& option);

/// A paragraph about an option that is too long for a terminal, or nothing.
std::string_view details_of(std::string_view option);

enum class HelpExtent { what_matters, everything };

/// Columns of the terminal: COLUMNS, else those that standard output has, else 80.
int terminal_width();

/// Prints pages for CLI11, wrapped to a width.
class HelpPage : public CLI::FormatterBase {
public:
  explicit HelpPage(int width) : width_(width) {}
  void show(HelpExtent extent) { extent_ = extent; }
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

private:
  int width_;
  HelpExtent extent_ = HelpExtent::what_matters;
};

/// All commands with all of their options, as Markdown.
std::string options_page(const CLI::App& program);

} // namespace meninas
