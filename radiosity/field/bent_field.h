// A field that is found, made finer where it bends.
//
// Elements in which indirect light bends by more than X of the scene's mean (bends.h) are divided,
// and light is gathered at the vertices that they get, up to three times.
// What light comes from stays as it was.
#pragma once

#include "radiosity/field/bends.h"
#include "radiosity/field/found_field.h"

namespace meninas {

/// The marked elements divided; what was found is kept.
FoundField divided(const FoundField& before, const SurfaceModel& surfaces,
                   std::span<const std::uint8_t> marked);

/// `result` has the field of what was found,
/// and takes the finer mesh and its field where anything bends, `found` as well. X = 0: nothing does.
void divide_bent(const LightScene& light, const VertexSource& source, const BendScale& scale,
                 double x, FoundField& found, InterpolatedField& result);

} // namespace meninas
