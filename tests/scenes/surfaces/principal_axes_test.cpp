// The axes of a symmetric matrix and the plane nearest to points, against closed forms.
#include "scenes/sampling.h"
#include "scenes/surfaces/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace meninas::test {
namespace {

TEST(PrincipalAxes, AddUpToTheMatrix) {
  const glm::dmat3 matrix(4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 1.0);
  const auto [values, axes] = principal_axes(matrix);
  EXPECT_LE(values[0], values[1]);
  EXPECT_LE(values[1], values[2]);
  glm::dmat3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k)
    sum += values[k] * glm::outerProduct(axes[k], axes[k]);
  for (int column = 0; column < 3; ++column)
    EXPECT_NEAR(glm::distance(sum[column], matrix[column]), 0.0,
                1e-14); // rounding of numbers below 5
}

/// Points of a plane far away, with heights that repeat at right angles: they leave the plane as it is.
TEST(PrincipalAxes, PlaneOfEvenHeightsIsTheirMean) {
  const Direction normal = glm::normalize(Vec3(1.0, 2.0, -2.0));
  const Direction u = glm::normalize(Vec3(2.0, -1.0, 0.0)), v = glm::cross(normal, u);
  const Point3 origin(1e6, -2e6, 3e6);
  std::vector<Vec3> points;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      points.push_back(x * u + y * v + 0.1 * x * y * normal);
  const Plane plane = fitted_plane(points, origin, -normal);
  EXPECT_NEAR(glm::distance(plane.normal, -normal), 0.0, 1e-14);
  EXPECT_NEAR(signed_distance(plane, origin), 0.0, 4e-9); // of coordinates of 4e6
}

/// Points that lie in a plane give it back.
TEST(PrincipalAxes, PlaneThroughPointsOfASlope) {
  std::vector<Vec3> points;
  for (std::uint32_t k = 0; k < 50; ++k) {
    const double x = 0x1p-32 * hash(k, 1, 0), y = 0x1p-32 * hash(k, 2, 0);
    points.push_back({x, y, 0.5 * x - 0.25 * y + 2.0});
  }
  const Plane plane = fitted_plane(points, Point3(0.0), {0, 0, 1});
  for (const Vec3& x : points)
    EXPECT_NEAR(signed_distance(plane, x), 0.0, 1e-14);
}

} // namespace
} // namespace meninas::test
