// NORMAL of a primitive, and how matrices move it.
//
//   n' = A^-T n / |A^-T n|        A the linear part of the matrix (glTF 2.0, 3.7.2.1 and 3.7.4)
//
// A^-T is the matrix of the cofactors over the determinant, whose sign is all that matters here.
// So a matrix that flattens a mesh still moves its normals.
#pragma once

#include "scenes/gltf/geometry/primitives.h"

#include <glm/mat4x4.hpp>

namespace meninas::gltf {

/// By vertex, in the coordinates of the mesh; of any length. Empty without NORMAL.
struct Normals {
  std::vector<Vec3> values;
  double error = 0.0; ///< radians, of normals that the file rounds to integers
};

/// Zero stands for what is no direction, which is then in the findings.
Normals decode_normals(const PrimitivePlace& at, Findings& findings);

Vec3 moved_normal(const glm::dmat4& matrix, const Vec3& normal);

} // namespace meninas::gltf
