// Gaps between walls that are no wider than a hair are closed.
//
// Walls that miss their floor by a fifth of a millimetre let the sky in by a slit of which one ray
// in many thousands finds the way: the little light there is comes in blots, and is no light that
// anyone meant. A loose edge of an opaque face, one that no other face shares, makes a gap if the
// middle of it is beside another opaque face at an angle of at least 30 degrees, both its ends are
// within w = 4e-4 of the radius of the scene's detail (precision.h) of that face's plane, and one at
// least is on the side where its own face is: where rounding has sunk the other end into the other
// face, the gap is a wedge. It is 20 times as long as the gap is wide.
// Its ends move within the plane of their own face into that of the other.
//
// Light that came through is left out: at most pi L times length times width, the whole slit seen
// from everywhere, with L what is outside.
#pragma once

#include "scenes/scene.h"

#include <string>

namespace meninas {

/// Where two faces, or walls of the same planes, come near one another.
struct ClosedJoint {
  NodeId node = none<NodeId>, other = none<NodeId>; ///< node <= other
  double width = 0.0;                               ///< the largest, metres
  double length = 0.0;                              ///< metres, of the edges along it
};

/// In the order in which the edges' faces are in the scene.
std::vector<ClosedJoint> close_hairline_gaps(Scene& scene);

/// One sentence about them; empty where there are none.
std::string describe_joints(const Scene& scene, const std::vector<ClosedJoint>& joints);

} // namespace meninas
