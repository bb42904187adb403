// The pixels (probes) at which the error of a picture is estimated.
//
// Interpolation errs where light bends within elements: at the foot of a bright wall,
// at the rim of a shadow; often in a few pixels that hold all of the error.
// V(p) is the radiance of p when each vertex's irradiance is replaced by its difference from the mean of
// its neighbours. Half of the pixels are drawn evenly,
// half with the probability V^2 / sum V^2, and together they count as if each were drawn with
//
//   q(p) = (1/N + V^2(p) / sum V^2) / 2
//
// of N pixels, by 1 / (N q) <= 2 (the balance heuristic: Veach and Guibas 1995).
// So means keep what they are, those of errors become more certain where V tells of them,
// and where it does not they have at most twice the variance.
#pragma once

#include "raytrace/field_shading.h"
#include "raytrace/render.h"

#include <cstdint>
#include <span>
#include <vector>

namespace meninas {

/// The mean of a value over the picture outside emitters is that over these of weight times value,
/// as far as so many tell; and over any first ones.
struct ProbeChoice {
  std::vector<glm::ivec2> pixels;
  std::vector<double> weight;
};

/// So many pixels outside emitters (by pixel, row by row: 1), some of them twice;
/// none where emitters are nearly everywhere. `light` is what is interpolated.
ProbeChoice choose_probes(const IrradianceField& field, FieldContent light,
                          const Camera& camera, const RenderSettings& settings,
                          std::span<const std::uint8_t> emits, int wanted);

} // namespace meninas
