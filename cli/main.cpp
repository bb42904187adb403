// meninas COMMAND SCENE [options]
//
// Every error is one line, `meninas: FILE: WHERE: WHAT`,
// on standard error, and an exit code that says whose fault it is.
#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/help.h"
#include "cli/values.h"
#include "runs/report/progress_line.h"
#include "scenes/version.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <new>

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

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      names.push_back("-" + name);
    }
  }
  return names;
}

/// What CLI11 could not place: options first, because what follows them may have been their values.
void refuse_leftovers(const CLI::App& app, const std::string& where) {
  const std::vector<std::string> leftovers = app.remaining();
  for (const std::string& text : leftovers) {
    if (text.size() > 1 && text.front() == '-') {
      const std::string name = text.substr(0, text.find('='));
      throw UsageError(where,
                       fmt::format("no option '{}'{}", name, hint_for(name, option_names(app))));
    }
  }
  if (!leftovers.empty()) {
    throw UsageError(where, fmt::format("too many arguments: '{}'", leftovers.front()));
  }
}

const Command* chosen_command(const CLI::App& program, const std::vector<Command>& commands) {
  const auto parsed = program.get_subcommands();
  for (const Command& command : commands) {
    if (!parsed.empty() && parsed.front() == command.options) {
      return &command;
    }
  }
  return nullptr;
}

[[noreturn]] void refuse_command(const CLI::App& program, const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) {
    names.push_back(command.options->get_name());
  }
  for (const std::string& text : program.remaining()) {
    if (!text.starts_with('-')) {
      throw UsageError("", fmt::format("no command '{}'{}", text, hint_for(text, names)));
    }
  }
  refuse_leftovers(program, "");
  throw UsageError("", "a command is needed, see meninas help");
}

/// What CLI11 is to parse, last one first.
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
void show_all_if_asked(std::vector<std::string>& arguments, HelpPage& page) {
  const auto all = std::ranges::find(arguments, "--help-all");
  if (all != arguments.end()) {
    *all = "--help";
    page.show(HelpExtent::everything);
  }
}

/// A program of all commands, none of them chosen yet.
struct Program {
  CLI::App options{"Meninas renders rooms with mirrors without noise", "meninas"};
  std::shared_ptr<HelpPage> page = std::make_shared<HelpPage>(terminal_width());
  std::vector<Command> commands;
};

/// Parses, then runs; help and version are answered on standard output.
int run(Program& whole, int argc, char** argv) {
  auto& [program, page, commands] = whole;
  std::optional<std::string> problem;
  try {
    std::vector<std::string> arguments = arguments_of(argc, argv);
    // For docs/options.md, in no help: last argument first.
    if (arguments == std::vector<std::string>{"--markdown", "help"}) {
      tell(stdout, options_page(program));
      return static_cast<int>(ExitCode::success);
    }
    take_words(arguments);
    show_all_if_asked(arguments, *page);
    program.parse(arguments);
  } catch (const CLI::Success& answer) {
    return program.exit(answer);
  } catch (const CLI::ParseError& error) {
    problem = error.what();
  }
  const Command* command = chosen_command(program, commands);
  if (command == nullptr) {
    refuse_command(program, commands);
  }
  refuse_leftovers(*command->options, command->options->get_name());
  if (problem) {
    throw UsageError(command->options->get_name(), *problem);
  }
  command->run();
  return static_cast<int>(ExitCode::success);
}

int guarded_main(int argc, char** argv) {
  Program whole;
  CLI::App& program = whole.options;
  program.formatter(whole.page);
  program.set_help_flag("-h,--help", "print this help");
  program.set_version_flag("--version", "meninas " + std::string(program_version()),
                           "print the version");
  program.footer("Exit codes: 1 a comparison beyond its limits, 2 wrong usage, 3 bad input, 4 "
                 "failed write or exhausted resource.");
  program.require_subcommand(0, 1);
  program.allow_extras();
  whole.commands = {
      add_render_command(program),  add_solve_command(program), add_plan_command(program),
      add_compare_command(program), add_batch_command(program), add_diff_command(program),
      add_regress_command(program), add_trade_command(program), add_formfactors_command(program)};
  for (const Command& command : whole.commands) {
    command.options->allow_extras();
  }
  return run(whole, argc, argv);
}

} // namespace
} // namespace meninas

int main(int argc, char** argv) {
  using meninas::ExitCode;
  meninas::keep_standard_error_taken();
  try {
    return meninas::guarded_main(argc, argv);
  } catch (const meninas::UserError& error) {
    return meninas::fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return meninas::fail(ExitCode::failed_output, "out of memory");
  } catch (const std::exception& error) {
    return meninas::fail(ExitCode::failed_output, fmt::format("internal error: {}", error.what()));
  }
}
