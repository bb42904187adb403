// A field that is found, made finer where it bends.
//
// Elements in which indirect light bends by more than X of the scene's mean (interpolation_error.h) are divided,
// and light is gathered at the vertices that they get, up to three times.
// The elements that send the light stay as they were.
#pragma once

#include "radiosity/field/interpolation_error.h"
#include "radiosity/field/final_gathering.h"

namespace meninas {

/// The marked elements divided; what was found is kept.
VertexSamples divided(const LightScene& light, const VertexSamples& before,
                   std::span<const std::uint8_t> marked);

/// `result` has the field of what was found,
/// and takes the finer mesh and its field where anything bends, `found` as well. X = 0: nothing does.
void refine_indirect(const LightScene& light, const VertexSource& source, const BendScale& scale,
                 double x, VertexSamples& found, InterpolatedField& result);

} // namespace meninas
