// The seconds of one piece of work on this machine, measured on some of many, from which `plan` forecasts the whole.
#pragma once

#include "scenes/stopwatch.h"

#include <algorithm>
#include <cstddef>

namespace meninas {

/// Seconds of one piece, the mean of at most `most` of them and of no more than take a tenth of a second, one
/// round at least. `work(first, last)` does the pieces [first, last) of an order whose every beginning is spread over
/// all; rounds are of `at_once` pieces and then double. The first is done once before, uncounted: it fills tables.
/// Limit: the last round ends after its time, so that all takes three tenths of a second, or two rounds of `at_once`
/// where they are longer.
template <typename Work>
double seconds_of_one(std::size_t most, std::size_t at_once, const Work& work) {
  constexpr double enough = 0.1;
  const std::size_t least = std::max<std::size_t>(at_once, 1);
  work(std::size_t{0}, std::min(most, least));
  Stopwatch watch;
  double seconds = 0.0;
  std::size_t done = 0;
  while (done < most && seconds < enough) {
    const std::size_t last = std::min(most, done + std::max(done, least));
    work(done, last);
    seconds += watch.lap();
    done = last;
  }
  return seconds / static_cast<double>(std::max<std::size_t>(done, 1));
}

} // namespace meninas
