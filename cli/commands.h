// The commands of the program, one file each, and the program that chooses among them.
#pragma once

#include "cli/options.h"

#include <functional>

namespace meninas {

/// A command's options, and what it does once they are parsed.
struct Command {
  Options* options = nullptr; ///< belongs to the program's options
  std::function<void()> run;
};

Command add_render_command(Options& program);
Command add_solve_command(Options& program);
Command add_plan_command(Options& program);
Command add_formfactors_command(Options& program);
Command add_diff_command(Options& program);
Command add_regress_command(Options& program);
Command add_compare_command(Options& program);
Command add_batch_command(Options& program);
Command add_merge_command(Options& program);
Command add_trade_command(Options& program);
Command add_walk_command(Options& program);
Command add_view_command(Options& program);
Command add_bake_command(Options& program);

/// The program: chooses the command by its arguments, and runs it. Every error is one line, `meninas: FILE: WHERE:
/// WHAT`, on standard error, and an exit code that says whose fault it is: what is returned.
int run_program(int argc, char** argv);

} // namespace meninas
