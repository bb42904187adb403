// Light from the source at vertices beside penumbrae.
//
// Few samples of an emitter's image decide whether it is seen in part (direct_irradiance.h).
// Where a little of it is hidden all of n may arrive, or none where little is seen:
// beside vertices that have met the edge such a one is a speck, by about 1 / n of the light.
// So where a vertex sees an image in part, all of its images take as many samples,
// and so do those of the vertices around it, and on outwards until all of these agree.
#pragma once

#include "radiosity/field/vertex_samples.h"

namespace meninas {

/// For vertices that have light from the source, alone or with the rest.
/// `level` tells apart the samples of vertices whose numbers are the same.
void resample_near_penumbrae(const VertexSource& source, std::uint32_t level, VertexSamples& found);

} // namespace meninas
