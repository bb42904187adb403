// Whether light can leave the scene through a gap between its faces.
//
// A face with an edge that no other face shares cannot be part of a shell, so it is peeled off,
// which may bare edges of its neighbours; what is left at the end has no gap anywhere.
// The scene is closed when that shell reaches as far as everything does.
// An edge may be shared with several shorter edges that lie on it (a wall beside two half walls).
#pragma once

#include "scenes/scene.h"

namespace meninas {

/// Points not farther apart than `tolerance` count as one.
/// O(n log n) but for the search for short edges on long ones, which is left out when
/// more than a few thousand edges are not shared: such a scene counts as open.
bool is_closed(const Scene& scene, double tolerance);

} // namespace meninas
