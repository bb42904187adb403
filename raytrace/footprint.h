// The footprint of a camera sample where it lands, straight or by way of mirrors:
// what a texture is averaged over.
//
// The samples of a pixel share its solid angle. With A the pixel's area in the picture plane
// at depth one, a ray of direction d (to that plane, so that its parameter t is depth,
// unfolded where mirrors are between) and n samples, the beam is at t as wide as a square of
//   s = t sqrt(A / (n abs(d))).
// Where samples come in rounds (sample_choice.h) n are those of a pixel so far,
// the round's among them: what blurs its texture, also into shadows that end within it,
// falls like the noise of its edges, as n^(-3/4). With the first round's n it would stay,
// however many samples there are, and be in every draw of them alike.
// Plane mirrors change neither t nor d's length, so that this holds behind any chain.
// On a surface met at cosine c the square becomes s by s / c, the longer side along the ray.
// With an orthographic camera s does not grow with t.
#pragma once

#include "raytrace/beams/lane_state.h"

namespace meninas {

/// In barycentric weights of the triangle that lane k has hit.
Footprint footprint_of(const LandedLane& lane);

} // namespace meninas
