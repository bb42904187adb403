// Direct light at vertices beside penumbrae.
//
//   D = sum over images of tau E F V,  V ~ k / n      W/m^2, k of n shadow rays unblocked
//
// With n samples a visibility below 1/n is missed (direct_irradiance.h). Next to correctly sampled
// vertices this shows as a speck of 1/n of the light. So where a vertex sees an image in part, all
// of its images take as many samples, and so do those of the vertices around it, outwards until all
// of these agree.
#pragma once

#include "radiosity/field/vertex_samples.h"

namespace meninas {

/// For vertices that have direct light, alone or with indirect light, and are seen: specks elsewhere show nowhere.
/// `level` tells apart the samples of vertices whose numbers are the same.
void resample_near_penumbrae(const VertexSource& source, std::uint32_t level, VertexSamples& found);

} // namespace meninas
