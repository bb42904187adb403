#include "cli/commands.h"
#include "cli/common_options.h"
#include "cli/settings.h"
#include "cli/values.h"
#include "runs/regress_run.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

namespace meninas {
namespace {

struct RegressOptions {
  RegressRequest request;
  std::optional<std::string> filter;
  Verbosity verbosity = Verbosity::normal;
};

const char* word_for(CaseStatus status) {
  switch (status) {
  case CaseStatus::passed:
    return "passed";
  case CaseStatus::updated:
    return "updated";
  case CaseStatus::failed:
    return "FAILED";
  case CaseStatus::broken:
    return "BROKEN";
  }
  return "";
}

/// The cases whose names contain the filter.
std::vector<RegressCase> chosen_cases(const RegressOptions& options) {
  auto cases = read_cases(options.request.cases_file, parse_render_settings);
  if (!options.filter) {
    return cases;
  }
  std::vector<std::string> names;
  for (const RegressCase& regress_case : cases) {
    names.push_back(regress_case.name);
  }
  std::erase_if(cases, [&](const RegressCase& regress_case) {
    return regress_case.name.find(*options.filter) == std::string::npos;
  });
  if (cases.empty()) {
    throw UsageError("--filter", fmt::format("no case is named like '{}'{}", *options.filter,
                                             hint_for(*options.filter, names)));
  }
  return cases;
}

/// Ends with the first broken case's own code, or with 1 where pictures differ.
void conclude(const RegressOptions& options, const std::vector<CaseResult>& results) {
  std::vector<std::string> failed;
  int code = static_cast<int>(ExitCode::success);
  for (const CaseResult& result : results) {
    if (result.status == CaseStatus::failed || result.status == CaseStatus::broken) {
      failed.push_back(result.name);
    }
    if (result.status == CaseStatus::broken && code == 0) {
      code = result.exit_code;
    }
  }
  if (!failed.empty()) {
    throw UserError(code == 0 ? ExitCode::out_of_tolerance : static_cast<ExitCode>(code),
                    options.request.cases_file.string(), "",
                    fmt::format("{} of {} cases failed: {}", failed.size(), results.size(),
                                fmt::join(failed, ", ")));
  }
}

void run(const RegressOptions& options) {
  const auto cases = chosen_cases(options);
  Console console(options.verbosity);
  const auto results =
      regress_run(options.request, cases, console.events(), [](const CaseResult& result) {
        std::cout << fmt::format("{:<8} {}: {} ({:.1f} s)\n", word_for(result.status), result.name,
                                 one_line(result.text), result.seconds)
                  << std::flush;
      });
  if (!std::cout) {
    throw OutputError("", "standard output", "cannot write");
  }
  conclude(options, results);
}

} // namespace

Command add_regress_command(Options& program) {
  Options& command =
      program.add_command("regress", "Render cases and compare them with their references");
  const auto options = std::make_shared<RegressOptions>();
  RegressRequest& request = options->request;
  command
      .add("CASES", "", "JSON: scenes, settings, references and limits",
           [=](const std::string& text) { options->request.cases_file = text; })
      .required();
  command.add("-o,--output", "DIR",
              fmt::format("folder for picture, reference and heat map of each failure [{}]",
                          request.output.string()),
              [&](const std::string& text) { request.output = text; });
  command.add("--filter", "TEXT", "run only the cases whose names contain TEXT",
              [=](const std::string& text) { options->filter = text; });
  add_file(command, "--junit", request.junit, "write JUnit XML");
  command.add_flag("--update", "make the references anew, and note the settings in manifest.json",
                   [=] { options->request.task = RegressTask::update; });
  command.add("--threads", "N", "number of threads [all cores]", [&](const std::string& text) {
    request.threads = static_cast<int>(parse_integer("--threads", text, 1, 1024));
  });
  command.add_flag("--quiet", "print results, warnings and errors only",
                   [=] { options->verbosity = Verbosity::quiet; });
  return {&command, [=] { run(*options); }};
}

} // namespace meninas
