// One primitive as it stands in the file, in the coordinates of its mesh; its node places it.
#pragma once

#include "scenes/gltf/geometry/file_triangles.h"
#include "scenes/gltf/geometry/normals.h"
#include "scenes/gltf/geometry/tangents.h"
#include "scenes/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace meninas::gltf {

struct Part {
  std::vector<Vec3> positions;
  std::vector<VertexAttributes> attributes;
  Normals normals;
  std::optional<TextureUse> tangent_map;
  bool anisotropic = false;
  Tangents tangents; ///< empty without a map for them
  std::vector<Corners> triangles;
  MaterialId material = none<MaterialId>;
  double step = 0.0; ///< of positions that the file rounds; 0: others
};

/// Gives a part with a map for tangents those of MikkTSpace (mikktspace.h) if it has none.
/// A vertex whose corners have several becomes so many. Where texture coordinates tell none and
/// facets are anisotropic, tangents are level (materials/normal_map.h): whether there are any such.
bool settle_tangents(Part& part);

} // namespace meninas::gltf
