// `batch`: the pictures of a jobs file, made side by side,
// with nothing lost when the process ends early and nothing done twice.
#pragma once

#include "runs/batch/batch_report.h"

namespace meninas {

struct BatchRequest {
  std::filesystem::path jobs_file;            ///< for messages and reports
  std::filesystem::path folder;               ///< made if it is not there
  std::optional<std::filesystem::path> cache; ///< of solutions; DIR/.meninas/solutions otherwise
  std::optional<std::filesystem::path> junit;
  GltfSettings gltf; ///< how scenes are read
  Resume resume = Resume::no;
  std::vector<NumberRange> only; ///< pictures; empty: all
  Shard shard;                   ///< of these
  std::optional<std::uint64_t> memory_limit; ///< bytes; what the machine allows otherwise
  int threads = 0;                           ///< 0: all the machine has
};

struct BatchEvents {
  RunEvents run;
  std::function<void(const BatchPicture&, const PictureResult&)> finished;
  std::function<void(const BatchProgress&, double seconds)> progress;
  /// Called before the process ends by itself:
  /// a signal has come, and what runs has not ended within a second.
  std::function<void(const std::string&)> last_words;
};

/// Makes this process' share of the pictures and writes summary.json and index.html into
/// the folder. Throws a UserError when not even a beginning can be made; when pictures have failed,
/// with the first one's exit code; and when it was stopped, with 128 + signal.
/// A picture that fails does not keep the others from being made.
BatchReport batch_run(const BatchRequest& request, std::vector<BatchPicture> pictures,
                      const BatchEvents& events = {});

/// The work that a batch would do, a line for each picture and solve. Touches nothing.
std::string batch_outlook(const BatchRequest& request, const std::vector<BatchPicture>& pictures);

} // namespace meninas
