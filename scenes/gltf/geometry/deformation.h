// Meshes that can move, as the file has them at rest:
// morph targets by their default weights, skins by where the joints are.
//
//   x = sum_j w_j J_j B_j (x_0 + sum_k m_k d_k)        glTF 2.0, 3.7.2.2 and 3.7.3
//
// with J_j the joint's matrix in the world, B_j its inverse bind matrix,
// m_k the weight and d_k the displacement of target k.
// The node of a skinned mesh does not move it: where it is follows from the joints alone.
#pragma once

#include "scenes/gltf/geometry/tangents.h"
#include "scenes/gltf/stages.h"

#include <map>

namespace meninas::gltf {

/// A primitive and the weights of its targets, those of the node or else of the mesh.
struct Morph {
  const Document& document;
  std::string where; ///< for messages
  const Json& primitive;
  std::span<const double> weights;
};

/// Adds the targets that have a weight to an attribute of the primitive, if there is any of it.
void apply_morph_targets(const Morph& morph, std::string_view attribute,
                         std::vector<Vec3>& values);

/// J_j B_j of the joints of skins, found once for all nodes that use them.
class Skins {
public:
  Skins(const Document& document, std::span<const PlacedNode> nodes);
  /// Empty when a joint is not in the chosen scene.
  const std::vector<glm::dmat4>& joints(std::size_t skin);

private:
  const Document& document_;
  std::vector<const PlacedNode*>
      placed_; ///< by their index in the file; null outside the chosen scene
  std::map<std::size_t, std::vector<glm::dmat4>> joints_;
};

/// A primitive and the matrices of the joints that its vertices follow.
struct Skinning {
  const Document& document;
  std::string where; ///< for messages
  const Json& primitive;
  std::span<const glm::dmat4> joints;
};

/// Positions of a primitive in the world, and its normals and tangents, if there are any.
/// False, with nothing moved, when it has no joints and weights.
bool apply_skin(const Skinning& skinning, std::vector<Vec3>& positions, std::vector<Vec3>& normals,
                Tangents& tangents);

} // namespace meninas::gltf
