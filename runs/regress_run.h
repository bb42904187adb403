// `regress`: renders cases and compares each with its reference by its own limits,
// or makes the references anew.
#pragma once

#include "runs/json/cases_file.h"
#include "runs/run_events.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

enum class RegressTask {
  compare, ///< a failure leaves NAME.exr, NAME.reference.exr and NAME.heat.png in the output folder
  update   ///< renders the references, and writes manifest.json beside them: how each came to be
};

struct RegressRequest {
  std::filesystem::path cases_file; ///< for messages and the manifest
  std::filesystem::path output = "regress-failures";
  std::optional<std::filesystem::path> junit; ///< results as JUnit XML
  RegressTask task = RegressTask::compare;
  int threads = 0; ///< 0: all the machine has
};

enum class CaseStatus { passed, updated, failed, broken };

struct CaseResult {
  std::string name;
  CaseStatus status = CaseStatus::passed;
  std::string text; ///< figures with their limits; what moved; or the error of a broken case
  double seconds = 0.0;
  int exit_code = 0; ///< of a broken case: what its error alone would end with
};

/// In the order of the cases. `done` is called after each.
/// A case that cannot be rendered or compared is broken and does not keep the others from running.
/// Consecutive cases with one scene and the same settings share the rendering.
std::vector<CaseResult> regress_run(const RegressRequest& request,
                                    const std::vector<RegressCase>& cases, const RunEvents& events,
                                    const std::function<void(const CaseResult&)>& done);

std::string junit_xml(const std::vector<CaseResult>& results, const std::string& suite);

} // namespace meninas
