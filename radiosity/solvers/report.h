// Conversion between colours, as scenes have them (R, G, B of W/m^2), and the values a system is solved in:
// one band where all is grey (R = G = B), else three; and the report of a solver at its end.
#pragma once

#include "radiosity/solvers/solver_settings.h"
#include "radiosity/solvers/convergence.h"

namespace meninas {

inline bool is_grey_colour(const Rgb& colour) { return colour.r == colour.g && colour.g == colour.b; }

/// In a grey system all channels are alike; this takes red.
template <typename Value>
Value value_of(const Rgb& colour) {
  if constexpr (channel_count<Value> == 1)
    return colour.r;
  else
    return colour;
}

template <typename Value>
std::vector<Value> values_of(const std::vector<Rgb>& colours) {
  std::vector<Value> values;
  values.reserve(colours.size());
  for (const auto& colour : colours)
    values.push_back(value_of<Value>(colour));
  return values;
}

template <typename Value>
std::vector<Rgb> colours_of(const std::vector<Value>& values) {
  std::vector<Rgb> colours;
  colours.reserve(values.size());
  for (const auto& value : values)
    colours.emplace_back(value);
  return colours;
}

template <typename Value>
SolverEnd end_of(const Convergence<Value>& convergence);

/// All but the radiosities.
template <typename Value>
SolverResult report_of(const SolverSettings& settings, const Convergence<Value>& convergence,
                       SolverEnd end);

} // namespace meninas
