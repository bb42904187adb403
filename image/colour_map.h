// From numbers to colours whose differences look as large as the differences of the numbers.
//
// "magma" by N. Smith and S. van der Walt (2015, released under CC0): lightness grows evenly
// from black over purple and orange to pale yellow, also in grey and for colour-blind eyes.
#pragma once

#include <glm/glm.hpp>

namespace meninas {

/// sRGB-encoded colour for t in [0, 1], clipped outside.
/// Off the published 256 colours by at most 2.6 / 255, between them.
glm::vec3 magma(double t);

/// sRGB-encoded colour for t in [-1, 1], clipped outside: blue below zero, orange above,
/// dark at zero. Its lightness in Oklab (B. Ottosson 2020) grows evenly with |t|.
glm::vec3 blue_orange(double t);

} // namespace meninas
