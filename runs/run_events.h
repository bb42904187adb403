// What a run tells while it runs. Nothing of it changes the result; every function may be empty.
#pragma once

#include "radiosity/transport/form_factors.h"

#include <functional>
#include <string>

namespace meninas {

struct RunEvents {
  std::function<void(const std::string&)> warning; ///< what a user has to know about the result
  std::function<void(const std::string&)> note;    ///< what is nice to know
  Progress progress;
};

inline void warn(const RunEvents& events, const std::string& text) {
  if (events.warning)
    events.warning(text);
}
inline void note(const RunEvents& events, const std::string& text) {
  if (events.note)
    events.note(text);
}

} // namespace meninas
