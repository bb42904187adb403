// The footprint of a camera sample where it lands, straight or by way of mirrors:
// what a texture is averaged over.
//
// The samples of a pixel share its solid angle. With A the pixel's area in the picture plane
// at depth one, a ray of direction d (to that plane, so that its parameter t is depth,
// unfolded where mirrors are between) and n samples, the beam is at t as wide as a square of
//   s = t sqrt(A / (n abs(d))).
// With rounds of samples (sample_choice.h), n counts all samples of the pixel so far, this round included,
// so texture blur falls with edge noise as n^(-3/4). With the first round's n the blur would never shrink,
// and would be the same in every draw.
// Plane mirrors change neither t nor d's length, so that this holds behind any chain.
// On a surface met at cosine c the square becomes s by s / c, the longer side along the ray.
// With an orthographic camera s does not grow with t.
#pragma once

#include "raytrace/beams/lane_state.h"

namespace meninas {

/// In barycentric weights of the triangle that lane k has hit.
Footprint footprint_of(const LandedLane& lane);

} // namespace meninas
