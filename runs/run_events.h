// The events of a run. They never change the result; every function may be empty.
#pragma once

#include "radiosity/transport/form_factors.h"

#include <functional>
#include <string>
#include <vector>

namespace meninas {

/// A stage of a run, and about what share of its time it takes.
struct RunStage {
  std::string name;
  double share = 1.0;
};

struct RunEvents {
  std::function<void(const std::string&)> warning; ///< what a user has to know about the result
  std::function<void(const std::string&)> note;    ///< what is nice to know
  Progress progress;
  /// The stages that are coming, before the first of them: their progress counts as one run's.
  std::function<void(const std::vector<RunStage>&)> stages;
};

inline void warn(const RunEvents& events, const std::string& text) {
  if (events.warning)
    events.warning(text);
}
inline void note(const RunEvents& events, const std::string& text) {
  if (events.note)
    events.note(text);
}

inline void begin_stages(const RunEvents& events, const std::vector<RunStage>& stages) {
  if (events.stages)
    events.stages(stages);
}

} // namespace meninas
