// The axes of a symmetric matrix of three rows, and the plane nearest to points that they give
// (Pearson 1901). Numbers that are not finite have axes that are not.
#pragma once

#include "scenes/surfaces/plane.h"

#include <array>
#include <span>

namespace meninas {

/// A = sum_k values[k] axes[k] axes[k]^T.
struct PrincipalAxes {
  std::array<double, 3> values{};  ///< in ascending order
  std::array<Direction, 3> axes{}; ///< of length one, at right angles to one another
};

/// The part below the diagonal is read.
PrincipalAxes principal_axes(const glm::dmat3& symmetric);

/// The plane through the mean of the points for which the sum of their squared distances is least.
/// Points are differences to `origin`, so that far coordinates cancel, and there is one at least.
/// The normal is on the side of `side`.
Plane fitted_plane(std::span<const Vec3> points, const Point3& origin, const Direction& side);

} // namespace meninas
