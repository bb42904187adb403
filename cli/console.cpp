#include "cli/common_options.h"
#include "runs/report/progress_line.h"

#include <fmt/format.h>

namespace meninas {

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      c = ' ';
    }
  }
  return text;
}

struct Console::State {
  explicit State(Verbosity level)
      : verbosity(level),
        line(stderr, level == Verbosity::quiet ? ProgressStyle::none : progress_style(stderr)) {}

  void say(const std::string& prefix, const std::string& text) {
    line.clear();
    tell(stderr, fmt::format("meninas: {}{}\n", prefix, one_line(text)));
  }

  Verbosity verbosity;
  ProgressLine line;
};

Console::Console(Verbosity verbosity) : state_(std::make_shared<State>(verbosity)) {}

Console::~Console() { state_->line.clear(); }

RunEvents Console::events() {
  RunEvents events;
  events.warning = [state = state_](const std::string& text) { state->say("warning: ", text); };
  if (state_->verbosity == Verbosity::quiet) {
    return events;
  }
  events.note = [state = state_](const std::string& text) { state->say("", text); };
  events.progress = [state = state_](std::string_view stage, double fraction) {
    state->line.report(stage, fraction);
  };
  events.stages = [state = state_](const std::vector<RunStage>& stages) {
    state->line.begin(stages);
  };
  return events;
}

void Console::show_status(const std::string& line) { state_->line.report(line); }

void Console::say_error(const std::string& line) { state_->say("", line); }

void Console::say_notes(const CommonOptions& options) {
  for (const std::string& text : options.notes) {
    note(events(), text);
  }
  for (const std::string& text : rounding_notes(options.settings)) {
    note(events(), text);
  }
}

} // namespace meninas
