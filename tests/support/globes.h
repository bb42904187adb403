// Spheres made of facets, for tests of curved surfaces.
#pragma once

#include "tests/support/scene_builder.h"

namespace meninas::test {

/// What a file says of the normals of facets.
enum class GivenNormals { none, flat, smooth };

struct Globe {
  Point3 centre{0.0};
  double radius = 1.0;
  int meridians = 24, parallels = 12;
  bool hollow = false; ///< seen from inside
};

/// Facets of a globe, every one a node of that name; the poles are fans of triangles.
void add_globe(Scene& scene, const std::string& name, const Globe& globe, const Material& material,
               GivenNormals normals = GivenNormals::none);

} // namespace meninas::test
