// The axes of a symmetric matrix of three rows, and the two problems of least squares that they solve:
// the plane nearest to points (Pearson 1901) and the pseudo-inverse (Golub and Van Loan, Matrix Computations, 5.5).
#pragma once

#include "scenes/surfaces/plane.h"

#include <array>
#include <span>

namespace meninas {

/// A = sum_k values[k] axes[k] axes[k]^T.
struct PrincipalAxes {
  std::array<double, 3> values; ///< in ascending order
  std::array<Direction, 3> axes; ///< of length one, at right angles to one another
};

/// Of a symmetric matrix, of which the part below the diagonal is read.
PrincipalAxes principal_axes(const glm::dmat3& symmetric);

/// The plane through the mean of the points for which the sum of their squared distances is least.
/// Points are differences to `origin`, so that far coordinates cancel, and one at least; the normal is on the side of `side`.
Plane fitted_plane(std::span<const Vec3> points, const Point3& origin, const Direction& side);

} // namespace meninas
