// What the reference traces: geometry, materials and lights of a scene, ready to be asked.
//
// It shares the scene and its ray queries with the two passes, and nothing else:
// no mesh, no mirror worlds, no form factors.
#pragma once

#include "reference/light_image.h"
#include "reference/light_table.h"
#include "scenes/materials/bsdf.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/surfaces/surfaces.h"
#include "scenes/materials/texture_lookup.h"

#include <vector>

namespace meninas::reference {

struct TracedScene {
  Scene scene;
  SurfaceModel surfaces;
  RayScene rays;
  std::vector<Direction> normals; ///< of the triangles, towards the front
  DecodedTextures textures;
  std::vector<Bsdf> bsdfs; ///< of the materials, without their textures
  LightTable lights;
  std::vector<PlaneId> mirror_planes; ///< mirrored_lights.h
  std::vector<LightImage> light_images;
  bool see_through = false; ///< there are panes or cut-outs that light passes straight
};

/// Where a ray has met a surface, as that surface is there.
struct SurfacePoint {
  TriangleId triangle = none<TriangleId>;
  Point3 position{0.0};
  PlaneId plane = none<PlaneId>;
  Direction normal{0.0, 0.0, 1.0}; ///< of the side that was met
  MaterialPoint material;
  Bsdf bsdf;
  bool hole = false; ///< cut out: nothing is there
  bool front = true;
  bool black = false; ///< the back of a single-sided surface: neither reflects nor emits
};

/// The point of a triangle with weights b1,
/// b2 of its second and third corner, met on its front or back.
SurfacePoint surface_point(const TracedScene& traced, TriangleId triangle, Vec2 barycentric,
                           bool front);

} // namespace meninas::reference
