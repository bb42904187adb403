// Polished dielectrics.
#pragma once

#include "scenes/material.h"

#include <cmath>

namespace meninas::test {

/// Diffuse below a coat of glass.
inline Material coated(Rgb reflectance, double roughness) {
  Material material;
  material.base_color = reflectance;
  material.roughness = roughness;
  return material;
}

/// The same, whose coat pass one takes for a mirror.
inline Material polished(Rgb reflectance) {
  Material material = coated(reflectance, 0.0);
  material.specular_in_pass_one = true;
  return material;
}

/// Schlick's R of glass, and its mean: F0 + (1 - F0) / 21.
inline double coat_reflectance(double cosine) { return 0.04 + 0.96 * std::pow(1.0 - cosine, 5); }
inline constexpr double mean_coat_reflectance = 0.04 + 0.96 / 21.0;

} // namespace meninas::test
