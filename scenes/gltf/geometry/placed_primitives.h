// The world positions of the triangles of a file's primitives, by node and copy, for writing the
// file back. Triangles in a Scene have been repaired (scenes/repair/), and are in another order.
#pragma once

#include "scenes/gltf/geometry/file_triangles.h"
#include "scenes/scene.h"

namespace meninas::gltf {

struct PlacedPrimitive {
  std::size_t file_node = 0; ///< into the file's nodes
  NodeId node = none<NodeId>; ///< that of the scene which read_gltf gives
  std::size_t mesh = 0, number = 0; ///< of the primitive among those of its mesh
  std::optional<std::size_t> copy;  ///< of EXT_mesh_gpu_instancing
  glm::dmat4 local{1.0};            ///< of a copy, from its mesh to its node
  bool mirrored = false;            ///< its triangles show their other side
  std::vector<Point3> positions;    ///< by vertex of the primitive, metres
  std::vector<Corners> triangles;   ///< as in the file
};

/// All that have triangles, in the order of `nodes`, then of the mesh, then of copies. Throws what
/// read_gltf throws of geometry.
std::vector<PlacedPrimitive> placed_primitives(const Document& document,
                                               std::span<const PlacedNode> nodes);

} // namespace meninas::gltf
