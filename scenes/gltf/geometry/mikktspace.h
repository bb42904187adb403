// Tangents of a mesh whose file gives none: MikkTSpace, as those who bake normal maps have them.
//
// Over a triangle the first texture coordinate u grows along (Mikkelsen 2008, Simulation of
// Wrinkled Surfaces Revisited, eq. 18)
//
//   T = sign (dv_2 e_1 - dv_1 e_2) / |...|,   sign = that of du_1 dv_2 - dv_1 du_2
//
// with e_k the edges from its first corner and (du_k, dv_k) their changes of the coordinates.
// Corners that share position, normal N and texture coordinate are one where edges join their
// triangles, from one to the next, and these have one sign. For them all
//
//   T = sum_k theta_k T_k' / |...|,   T_k' = (T_k - (T_k.N) N) / |...|
//
// with theta_k the angle at the corner, seen along N. A triangle over which the coordinates do not
// change goes with the first that reach it, and adds nothing.
//
// Corners are one, and triangles are met in the order, as in mikktspace.c (Mikkelsen 2011); but
// that keeps directions apart that are opposite to the last bit, and does not sort its last edges,
// where it may miss neighbours.
#pragma once

#include "scenes/types.h"

#include <array>
#include <span>
#include <vector>

namespace meninas::gltf {

/// By vertex. Normals are of any length: of those that are absent or zero the face has its own.
struct TexturedMesh {
  std::span<const Vec3> positions, normals;
  std::span<const Vec2> texcoords;
  std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// By triangle and corner: T, and w = -sign, so that w N x T runs up the image, against v
/// (glTF 2.0, 3.7.2.1); zero where no triangle around the corner tells.
std::vector<std::array<glm::vec4, 3>> mikktspace_tangents(const TexturedMesh& mesh);

} // namespace meninas::gltf
