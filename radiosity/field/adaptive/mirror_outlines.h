// Where the light that mirrors throw ends:
// the outlines of the windows as the emitters' images project them onto the sides.
//
// An image T_w e lights, of a plane, what its points see through the windows of w:
// the projections of a window's edges from the corners of the image bound the penumbra
// of the spot's edge. They are kept as points along them. Blockers are left aside.
#pragma once

#include "radiosity/scene/light_scene.h"

namespace meninas {

struct OutlinePoint {
  SideId side;
  Vec2 uv;
};
using MirrorOutlines = std::vector<OutlinePoint>;

/// Points no further apart than `spacing`, metres.
/// Of at most `most` pairs of an emitter and a world, the brightest worlds first.
MirrorOutlines mirror_outlines(const LightScene& light, double spacing, std::size_t most = 64);

} // namespace meninas
