// Oddities of a scene, node by node with counts, in the words of its modeller and with a remedy for each.
//
// Nothing of it stops a run: every scene is rendered as it stands.
// But a mesh turned inside out is black, a face that is there twice is lit as one of the two, and a
// scene in millimetres has elements of metres. Where light is right all the same, the line says so.
#pragma once

#include "scenes/rays/ray_scene.h"

namespace meninas {

/// The kinds are names for programs (`plan --json`); they stay.
struct Oddity {
  std::string kind;
  std::string node;  ///< or camera; empty: the whole scene
  std::string other; ///< the node it is about besides, or empty
  std::size_t count = 0;
  std::string text; ///< one sentence
};

/// Ordered by kind, then by node as in the scene. O(n log n) in triangles and vertices.
std::vector<Oddity> report_scene(const Scene& scene, const SurfaceModel& surfaces,
                                 const RayScene& rays);

} // namespace meninas
