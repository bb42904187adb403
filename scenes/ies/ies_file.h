// IES files: intensity distributions of luminaires as text, LM-63-1986, 1991, 1995, 2002 and 2019.
//
//   I = candela value * candela multiplier * ballast factor
//
// times the ballast-lamp photometric factor in files before 1995, whose place later ones keep free.
// Photometry of types C and B with TILT=NONE is read; keywords, lamps, lumens, watts and the opening's
// size are not needed for light and not looked at.
#pragma once

#include "scenes/ies/intensity_distribution.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace meninas {

/// A problem of the text, and its line, from 1 on.
struct IesProblem : std::runtime_error {
  IesProblem(std::size_t at, const std::string& what) : std::runtime_error(what), line(at) {}
  std::size_t line;
};

/// Throws IesProblem.
IntensityDistribution parse_ies(std::string_view text);

} // namespace meninas
