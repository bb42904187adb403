// TANGENT of a primitive, for its normal map or its anisotropy (materials/normal_map.h), and how
// matrices move it.
//
//   T' = A T / |A T|,   w' = w sign(det A)       A the linear part of the matrix
//
// B = w N x T is then what A makes of it, too, where A mirrors: N is moved by A^-T (normals.h).
//
// The file's T is along its texture coordinates. Where KHR_texture_transform turns the image on
// them by r, and scales them by s_u and s_v, the map's is
//
//   T' ~ cos(r)/s_u T - sin(r)/s_v B,   w' = w sign(s_u s_v)
//
// as in the Khronos sample renderer. It is exact where u and v are stretched alike and s_u = s_v,
// and for right angles. A file without tangents has those of MikkTSpace (mikktspace.h), by the
// coordinates as the transform makes them.
#pragma once

#include "scenes/gltf/geometry/primitives.h"
#include "scenes/material.h"

#include <glm/mat4x4.hpp>

#include <span>
#include <vector>

namespace meninas::gltf {

/// By vertex, in the coordinates of the mesh.
struct Tangents {
  std::vector<Vec3> directions; ///< T, of any length; zero stands for what cannot be used
  std::vector<double> signs;    ///< w, +1 or -1, and 0 with a T of zero
};

/// As the file has them; empty without TANGENT.
Tangents decode_tangents(const PrimitivePlace& at);

/// Tangents, once morphed, across their normals and along the image. Empty where none can be used;
/// what cannot, and why, is then in the findings.
Tangents usable_tangents(const PrimitivePlace& at, Tangents tangents, std::span<const Vec3> normals,
                         const TextureUse& map, Findings& findings);

void move_tangent(const glm::dmat4& matrix, Vec3& direction, double& sign);

} // namespace meninas::gltf
