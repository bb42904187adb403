// Metals of any roughness.
#pragma once

#include "scenes/material.h"

namespace meninas::test {

inline Material metal(Rgb reflectance, double roughness) {
  Material material;
  material.base_color = reflectance;
  material.metallic = 1.0;
  material.roughness = roughness;
  return material;
}

} // namespace meninas::test
