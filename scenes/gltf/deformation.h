// Meshes that can move, as the file has them at rest:
// morph targets by their default weights, skins by where the joints are.
//
//   x = sum_j w_j J_j B_j (x_0 + sum_k m_k d_k)        glTF 2.0, 3.7.2.2 and 3.7.3
//
// with J_j the joint's matrix in the world, B_j its inverse bind matrix,
// m_k the weight and d_k the displacement of target k.
// The node of a skinned mesh does not move it: where it is follows from the joints alone.
#pragma once

#include "scenes/gltf/stages.h"

#include <map>

namespace meninas::gltf {

/// Adds the targets that have a weight (of the node,
/// or else of the mesh) to the positions of a primitive.
void apply_morph_targets(const Document& document, const std::string& where, const Json& primitive,
                         std::span<const double> weights, std::vector<Vec3>& positions);

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

/// Positions of a primitive in the world.
/// False, with nothing moved, when it has no joints and weights.
bool apply_skin(const Document& document, const std::string& where, const Json& primitive,
                std::span<const glm::dmat4> joints, std::vector<Vec3>& positions);

} // namespace meninas::gltf
