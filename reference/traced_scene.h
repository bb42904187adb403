// The scene of the path tracer: geometry, materials and lights, ready for queries.
//
// It shares the scene and its ray queries with the two passes, and nothing else:
// no mesh, no mirror worlds, no form factors.
#pragma once

#include "reference/light_image.h"
#include "reference/light_table.h"
#include "reference/sky_table.h"
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
  SkyTable sky;
  bool see_through = false; ///< there are panes or cut-outs that light passes straight
};

/// Where a ray has met a surface, as that surface is there.
struct SurfacePoint {
  TriangleId triangle = none<TriangleId>;
  Point3 position{0.0};
  PlaneId plane = none<PlaneId>;
  Direction face{0.0, 0.0, 1.0}; ///< normal of the side that was met
  Direction normal{0.0, 0.0, 1.0}; ///< by which it reflects: that of the face, or of the curve
  Point3 origin{0.0}; ///< of light that it receives or reflects: the position, or on the curve
  PlaneId leaving = none<PlaneId>; ///< by that light: the plane of a flat surface
  MaterialPoint material;
  Bsdf bsdf;
  bool hole = false; ///< cut out: nothing is there
  bool front = true;
  bool black = false; ///< the back of a single-sided surface: neither reflects nor emits
};

/// The point of a triangle with weights b1,
/// b2 of its second and third corner, met on its front or back. It is flat so far.
SurfacePoint surface_point(const TracedScene& traced, TriangleId triangle, Vec2 barycentric,
                           bool front);

/// Makes a point of a curved triangle one of the curve (scenes/shading_normal.h),
/// seen from the direction `out` above the face; facets that are not round get their axis there.
void bend(const TracedScene& traced, Vec2 barycentric, const Direction& out, SurfacePoint& at);

} // namespace meninas::reference
