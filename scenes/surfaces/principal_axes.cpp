#include "scenes/surfaces/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace meninas {

PrincipalAxes principal_axes(const glm::dmat3& symmetric) {
  Eigen::Matrix3d matrix;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      matrix(row, column) = symmetric[column][row];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  PrincipalAxes principal;
  for (int k = 0; k < 3; ++k) {
    const auto axis = solver.eigenvectors().col(k);
    principal.values[static_cast<std::size_t>(k)] = solver.eigenvalues()[k];
    principal.axes[static_cast<std::size_t>(k)] = {axis.x(), axis.y(), axis.z()};
  }
  return principal;
}

Plane fitted_plane(std::span<const Vec3> points, const Point3& origin, const Direction& side) {
  Vec3 sum(0.0);
  for (const Vec3& x : points)
    sum += x;
  const Vec3 mean = sum / static_cast<double>(points.size());
  glm::dmat3 squares(0.0);
  for (const Vec3& x : points)
    squares += glm::outerProduct(x - mean, x - mean);
  Direction normal = glm::normalize(principal_axes(squares).axes[0]);
  normal = glm::dot(normal, side) < 0.0 ? -normal : normal;
  return {normal, glm::dot(normal, origin) + glm::dot(normal, mean)};
}

} // namespace meninas
