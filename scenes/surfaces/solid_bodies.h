// The solids of glass in a scene, for those who look for the light that they throw.
//
// A body is what triangles of solid glass form that share corners, be they several shells; where
// there are more than `max_bodies`, those that lie together are one. Each has a sphere around it.
#pragma once

#include "scenes/materials/bsdf.h"
#include "scenes/rays/ray_scene.h"

#include <vector>

namespace meninas {

inline constexpr std::size_t max_bodies = 16;

/// In the frame of the ray scene.
struct SolidBody {
  Point3 centre{0.0};
  double radius = 0.0;
};

struct SolidBodies {
  static constexpr std::uint32_t no_body = 0xffffffffU;

  std::vector<Bsdf> faces; ///< by MaterialId, without textures: what one face reflects and passes, from outside
  std::vector<std::uint32_t> body_of_triangle; ///< index into `bodies`, or no_body
  std::vector<SolidBody> bodies;

  bool empty() const { return bodies.empty(); }
};

/// All empty where no material is solid glass.
SolidBodies find_solid_bodies(const Scene& scene, const RayFrame& frame);

} // namespace meninas
