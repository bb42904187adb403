// The reports at the end of a batch:
// summary.json for programs, index.html (a contact sheet) for people, JUnit XML for servers.
//
// They speak of all pictures of the jobs file, whichever process has made them:
// whoever ends last says everything.
#pragma once

#include "runs/batch/batch_work.h"

namespace meninas {

struct BatchReport {
  std::filesystem::path jobs_file;
  std::filesystem::path folder;
  std::vector<BatchPicture> pictures;
  std::vector<PictureResult> results; ///< by picture
  std::vector<SolveResult> solves;    ///< of this process
  double seconds = 0.0;               ///< of this process, by the clock
  std::uint64_t rays = 0;             ///< likewise
  std::uint64_t peak_memory_bytes = 0;
  int threads = 0;
};

struct BatchCounts {
  std::size_t made = 0, found = 0, failed = 0, open = 0;
};
BatchCounts count(std::span<const PictureResult> results);

/// {"jobs_file", "version", "pictures": [{"name", "status", "job", "scene", "camera", "mode",
/// "frame", "at"?, "width", "height", "files", "seconds", "rays", "error"?, "exit_code"?}], "counts":
/// {"pictures", "made", "found", "failed", "open"}, "solves":
/// [{"scene", "key", "solved", "seconds", "elements", "error_bound", "converged"}],
/// "seconds", "rays", "rays_per_second", "peak_memory_bytes", "threads"}.
/// `made` by this process, `found` done by others or before; `open` not done yet.
std::string summary_json(const BatchReport& report);

/// Self-contained but for the links to the pictures.
std::string contact_sheet(const BatchReport& report);

/// A picture is a test case: it passes when it is there.
std::string batch_junit(const BatchReport& report);

} // namespace meninas
