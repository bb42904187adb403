// Meshes without light: scenes of a few polygons, divided into elements.
#pragma once

#include "radiosity/mesh/element_mesh.h"
#include "tests/support/scene_builder.h"

namespace meninas::test {

struct Meshed {
  Scene scene;
  SurfaceModel surfaces;
  ElementMesh mesh;
};
Meshed meshed(Scene scene, const MeshSettings& settings);

/// The unit square.
Scene square();

/// A parallelogram, a trapezoid, a general quad, triangles, a sliver, a ribbon.
Scene all_shapes();

/// A wall of two quads and two triangles in one material: one surface.
Scene patched_wall();

} // namespace meninas::test
