// Errors that end a run.
// Each is one line on stderr, `meninas: FILE: WHERE: WHAT`, and an exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace meninas {

enum class ExitCode { success = 0, out_of_tolerance = 1, usage = 2, bad_input = 3, failed_output = 4 };

/// Base of all errors a user can cause. `what()` is `FILE: WHERE: WHAT`; empty parts are left out.
class UserError : public std::runtime_error {
public:
  UserError(ExitCode code, std::string_view file, std::string_view where, std::string_view what);
  ExitCode code() const { return code_; }

private:
  ExitCode code_;
};

/// A file that cannot be read or does not say something meaningful. Exit code 3.
struct InputError : UserError {
  InputError(std::string_view file, std::string_view where, std::string_view what)
      : UserError(ExitCode::bad_input, file, where, what) {}
};

/// A result that cannot be written, or memory that is not there. Exit code 4.
struct OutputError : UserError {
  OutputError(std::string_view file, std::string_view where, std::string_view what)
      : UserError(ExitCode::failed_output, file, where, what) {}
};

/// An option, command or name the program does not know. Exit code 2.
struct UsageError : UserError {
  UsageError(std::string_view where, std::string_view what)
      : UserError(ExitCode::usage, "", where, what) {}
};

} // namespace meninas
