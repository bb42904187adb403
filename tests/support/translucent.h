// Sheets for tests: cloth and paper that pass light evenly.
#pragma once

#include "tests/support/scene_builder.h"

namespace meninas::test {

/// rho = (1 - t) base, tau = t passed.
inline Material translucent(Rgb base, double t, Rgb passed) {
  Material material = double_sided(diffuse(base));
  material.diffuse_transmission = t;
  material.diffuse_transmission_color = passed;
  return material;
}

} // namespace meninas::test
