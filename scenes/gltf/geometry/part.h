// One primitive as it stands in the file, in the coordinates of its mesh; its node places it.
#pragma once

#include "scenes/gltf/geometry/normals.h"
#include "scenes/gltf/geometry/tangents.h"
#include "scenes/types.h"

#include <array>
#include <optional>
#include <vector>

namespace meninas::gltf {

using Corners = std::array<std::uint32_t, 3>; ///< of a triangle, by vertex of its part

struct Part {
  std::vector<Vec3> positions;
  std::vector<std::array<glm::vec2, 2>> texcoords;
  std::vector<glm::vec4> colors; ///< empty without COLOR_0
  Normals normals;
  std::optional<TextureUse> normal_map;
  Tangents tangents; ///< empty without a normal map
  std::vector<Corners> triangles;
  MaterialId material = none<MaterialId>;
  double step = 0.0; ///< of positions that the file rounds; 0: others
};

/// Gives a part with a normal map the tangents of MikkTSpace (mikktspace.h) if it has none.
/// A vertex whose corners have several becomes so many.
void settle_tangents(Part& part);

} // namespace meninas::gltf
