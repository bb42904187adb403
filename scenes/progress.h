// The progress of a long computation.
#pragma once

#include <functional>
#include <string_view>

namespace meninas {

/// Called with the stage's name and the fraction of it that is done, from any thread;
/// may be empty. Never affects the result.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// A part of a stage, from one fraction of it to another.
struct StagePart {
  Progress progress = {};
  std::string_view stage = {};
  double from = 0.0, to = 1.0;
};

inline void report(const StagePart& part, double fraction) {
  if (part.progress)
    part.progress(part.stage, part.from + (part.to - part.from) * fraction);
}

} // namespace meninas
