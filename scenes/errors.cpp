#include "scenes/errors.h"

#include "scenes/types.h"

#include <fmt/format.h>

namespace meninas {

static std::string join_parts(std::string_view file, std::string_view where, std::string_view what) {
  std::string line;
  for (const auto part : {file, where, what}) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += part;
  }
  return line;
}

UserError::UserError(ExitCode code, std::string_view file, std::string_view where,
                     std::string_view what)
    : std::runtime_error(join_parts(file, where, what)), code_(code) {}

void expects(bool condition, std::string_view message, std::source_location where) {
  if (condition) return;
  throw std::logic_error(
      fmt::format("{}:{}: {}", where.file_name(), where.line(), message));
}

} // namespace meninas
