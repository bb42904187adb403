// What `meninas` does with its arguments: the whole program but main().
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/heap_pages.h"
#include "cli/help/completion.h"
#include "cli/help/help.h"
#include "cli/help/manual.h"
#include "cli/values.h"
#include "runs/report/progress_line.h"
#include "scenes/version.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <optional>
#include <string_view>

namespace meninas {
namespace {

/// Where standard error is closed the next file that is opened would take its place,
/// and messages would be written into it.
void keep_standard_error_taken() {
  if (fcntl(STDERR_FILENO, F_GETFD) != -1)
    return;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere == -1 || nowhere == STDERR_FILENO)
    return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

int fail(ExitCode code, const std::string& line) {
  tell(stderr, fmt::format("meninas: {}\n", one_line(line)));
  return static_cast<int>(code);
}

std::vector<std::string> option_names(const Options& command) {
  std::vector<std::string> names;
  for (const OptionInfo& option : command.list()) {
    for (const std::string& name : option.long_names) {
      names.push_back("--" + name);
    }
    for (const std::string& name : option.short_names) {
      names.push_back("-" + name);
    }
  }
  return names;
}

/// What nothing took: options first, because what follows them may have been their values.
void refuse_leftovers(const Options& command, const std::string& where) {
  const std::vector<std::string> leftovers = command.remaining();
  for (const std::string& text : leftovers) {
    if (text.size() > 1 && text.front() == '-') {
      const std::string name = text.substr(0, text.find('='));
      throw UsageError(
          where, fmt::format("no option '{}'{}", name, hint_for(name, option_names(command))));
    }
  }
  if (!leftovers.empty()) {
    throw UsageError(where, fmt::format("too many arguments: '{}'", leftovers.front()));
  }
}

[[noreturn]] void refuse_command(const Options& program) {
  std::vector<std::string> names;
  for (const Options* command : program.commands()) {
    names.push_back(command->name());
  }
  for (const std::string& text : program.remaining()) {
    if (!text.starts_with('-')) {
      throw UsageError("", fmt::format("no command '{}'{}", text, hint_for(text, names)));
    }
  }
  refuse_leftovers(program, "");
  throw UsageError("", "a command is needed, see meninas help");
}

/// What is to be parsed, last one first.
/// An option with a value that may be left out takes what follows only if that is a number:
/// otherwise it would take the scene.
std::vector<std::string> arguments_of(int argc, char** argv) {
  const auto is_number = [](const std::string& text) {
    return text.find_first_of("0123456789") != std::string::npos &&
           text.find_first_not_of("0123456789.eE+-") == std::string::npos;
  };
  std::vector<std::string> arguments;
  for (int k = argc - 1; k > 0; --k) {
    const std::string argument = argv[k];
    const bool bare =
        argument == "--adaptive" && (arguments.empty() || !is_number(arguments.back()));
    arguments.push_back(bare ? argument + '=' + preset_value : argument);
  }
  return arguments;
}

/// `meninas help [COMMAND]` and `meninas version` mean what they say, nothing at all asks for help,
/// and a scene without a command is rendered. The first argument comes last here.
void take_words(std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    arguments = {"--help"};
    return;
  }
  const std::string first = arguments.back();
  if (first == "version") {
    arguments.back() = "--version";
  } else if (first == "help") {
    arguments.pop_back();
    arguments.insert(arguments.begin(), "--help");
  } else if (first.ends_with(".gltf") || first.ends_with(".glb")) {
    arguments.push_back("render");
  }
}

/// `--help-all` is `-h` with all options.
HelpExtent asked_extent(std::vector<std::string>& arguments) {
  const auto all = std::ranges::find(arguments, "--help-all");
  if (all == arguments.end()) {
    return HelpExtent::what_matters;
  }
  *all = "--help";
  return HelpExtent::everything;
}

std::vector<Command> add_commands(Options& program) {
  return {
      add_render_command(program),  add_solve_command(program), add_plan_command(program),
      add_compare_command(program), add_batch_command(program), add_diff_command(program),
      add_regress_command(program), add_trade_command(program), add_formfactors_command(program),
      add_walk_command(program),    add_view_command(program), add_bake_command(program),
      add_merge_command(program)};
}

void run_chosen(const Options& program, const std::vector<Command>& commands,
                const Parsed& parsed) {
  const Options* const chosen = program.chosen_command();
  if (chosen == nullptr) {
    refuse_command(program);
  }
  refuse_leftovers(*chosen, chosen->name());
  if (parsed.outcome == Parsed::Outcome::wrong) {
    throw UsageError(chosen->name(), parsed.problem);
  }
  std::ranges::find(commands, chosen, &Command::options)->run();
}

/// What is made of all options at once, and stands in no help: `meninas help --markdown` is docs/options.md,
/// `--man [COMMAND]` a manual page, `--completion SHELL` a script. The first argument comes last here.
std::optional<std::string> made_page(const Options& program,
                                     const std::vector<std::string>& arguments) {
  if (arguments.size() < 2 || arguments.size() > 3 || arguments.back() != "help")
    return std::nullopt;
  const std::string& page = arguments.end()[-2];
  const std::string about = arguments.size() == 3 ? arguments.front() : "";
  if (page == "--markdown" && about.empty())
    return options_page(program);
  if (page == "--man")
    return manual_page(program, about);
  if (page == "--completion")
    return completion_script(program, about);
  return std::nullopt;
}

/// Parses, then runs; help and version are answered on standard output.
void guarded_main(int argc, char** argv) {
  Options program("Meninas renders rooms with mirrors without noise", "meninas");
  program.set_help("-h,--help", "print this help");
  program.add_flag("--version", "print the version", [] {
    tell(stdout, fmt::format("meninas {}\n", program_version()));
    throw Answered{};
  });
  const std::vector<Command> commands = add_commands(program);
  std::vector<std::string> arguments = arguments_of(argc, argv);
  if (const auto page = made_page(program, arguments)) {
    tell(stdout, *page);
    return;
  }
  take_words(arguments);
  const HelpExtent extent = asked_extent(arguments);
  const Parsed parsed = program.parse(arguments);
  if (parsed.outcome == Parsed::Outcome::wants_help) {
    tell(stdout, help_page(program, extent, terminal_width()));
  } else if (parsed.outcome != Parsed::Outcome::answered) {
    run_chosen(program, commands, parsed);
  }
}

} // namespace

int run_program(int argc, char** argv) {
  keep_standard_error_taken();
  keep_heap_in_large_pages();
  try {
    guarded_main(argc, argv);
    return static_cast<int>(ExitCode::success);
  } catch (const UserError& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::failed_output, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed_output, fmt::format("internal error: {}", error.what()));
  }
}

} // namespace meninas
