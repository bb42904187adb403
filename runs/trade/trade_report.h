// The report of a sweep: as figures, as a table and as a page.
#pragma once

#include "runs/trade/trade_point.h"

#include <filesystem>
#include <optional>

namespace meninas {

/// The reference against which errors are measured.
struct TradeReference {
  std::string kind;     ///< "path tracer" or "file"
  std::string name;     ///< of the file, or how long it was traced
  double seconds = 0.0; ///< it took
  double noise = 0.0;   ///< relative standard error of a pixel, in the mean square; 0: not known
  double floor = 0.0;   ///< errors below cannot be told from its noise
  Image mean;
  std::optional<Image> variance; ///< taken off the errors
};

struct TradeResult {
  std::filesystem::path scene;
  std::optional<std::string> camera; ///< as asked for
  double budget = 0.0, spent = 0.0;  ///< seconds
  int threads = 0;
  TradeReference reference;
  std::vector<TradePoint> points;
};

/// The worth of one turn of a parameter at its place: the ratios of seconds and errors,
/// and the gain left after the time is accounted for by error ~ seconds^-slope.
struct ParameterWorth {
  ParameterChange turn;
  std::size_t point = 0;
  double seconds = 1.0, error = 1.0; ///< after over before
};
/// Turns from the draft alone, those that bring most accuracy per second first:
/// a fall of the error that costs no time is best, a rise worst.
std::vector<ParameterWorth> parameter_worths(const TradeResult& result);

/// {"scene", "camera", "width", "height", "threads", "budget", "spent", "reference":
/// {"kind", "name", "seconds", "noise", "floor"}, "front":
/// [indices], "points": [{"id", "command", "options", "elements", "seconds", "seconds_spread",
/// "processor_seconds", "error", "error_spread", "runs", "estimate", "front", "turn"?:
/// {"knob", "from", "to", "parent"}, "stages": {...}}], "knobs":
/// [{"knob", "from", "to", "point", "seconds_ratio", "error_ratio"}], "conclusion", "version"}.
std::string trade_json(const TradeResult& result);

/// A line a point: id, front, seconds, processor_seconds, error, estimate, runs, elements, command.
std::string trade_csv(const TradeResult& result);

/// Self-contained; its data are those of the JSON, and thumbnails.
std::string trade_page_of(const TradeResult& result);

} // namespace meninas
