// Rooms that glow everywhere, seen in mirrors.
#pragma once

#include "mirror/virtual_lights.h"
#include "tests/support/scene_builder.h"

namespace meninas::test {

/// A room whose walls all emit but for some mirrors,
/// so that an observer sees light wherever it looks.
struct GlowingRoom {
  Scene scene;
  SurfaceModel surfaces;
  MirrorSet mirrors;
  WorldTree worlds;
  std::vector<Emitter> emitters;
};

GlowingRoom glowing(Scene scene, const WorldSettings& settings);

/// 1 x 1.5 x 2 m from the origin; walls x = 0, x = 1, y = 0, ...
Scene room_with_mirrors(const std::array<bool, 6>& is_mirror_wall);

/// The wall x = 0 of that room again, as a frame of four pieces around a mirror off its centre.
Scene room_with_mirror_in_wall();

/// A wedge of mirror cuts a corner off the room.
Scene room_with_wedge();

} // namespace meninas::test
