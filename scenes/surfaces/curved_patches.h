// Patches of curved surfaces: those with a triangle that reflects by normals which turn
// (scenes/shading_normal.h).
#pragma once

#include "scenes/scene.h"
#include "scenes/surfaces/surfaces.h"

#include <algorithm>

namespace meninas {

inline bool is_curved(const Scene& scene, const Patch& patch) {
  return std::ranges::any_of(patch.triangles, [&](TriangleId triangle) {
    return triangle != none<TriangleId> && scene.triangles[index(triangle)].curved;
  });
}

} // namespace meninas
