// The commands of the program, one file each.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace meninas {

/// A command's options, and what it does once they are parsed.
struct Command {
  CLI::App* options = nullptr; ///< belongs to the program's options
  std::function<void()> run;
};

Command add_render_command(CLI::App& program);
Command add_solve_command(CLI::App& program);
Command add_plan_command(CLI::App& program);
Command add_formfactors_command(CLI::App& program);
Command add_diff_command(CLI::App& program);
Command add_regress_command(CLI::App& program);
Command add_compare_command(CLI::App& program);
Command add_batch_command(CLI::App& program);
Command add_trade_command(CLI::App& program);

} // namespace meninas
