#include "mirror/convex_polygon.h"
#include "form_factors/point_form_factor.h"
#include "tests/form_factors/known_form_factors.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

double clipped_form_factor(const Point3& x, const Direction& n, std::span<const Point3> polygon) {
  return point_form_factor(x, n, clip(ConvexPolygon(polygon), x, n).span());
}

// The header promises 1e-12;
// below 1e-3 m in front of the centre of a square the terms cancel to 1e-15 of 1, no more.
TEST(PointFormFactor, KnownValues) {
  for (const auto& c : known_point_form_factors())
    EXPECT_NEAR(clipped_form_factor(c.point, glm::normalize(c.normal), c.polygon), c.form_factor,
                1e-12 * c.form_factor)
        << c.name;
}

// Howell C-11 for a point below a corner of a rectangle a x b at distance h, with A = a/h, B = b/h:
//   F = 1/(2 pi) (A/sqrt(1+A^2) atan(B/sqrt(1+A^2)) + B/sqrt(1+B^2) atan(A/sqrt(1+B^2))).
TEST(PointFormFactor, ParallelRectangleAboveItsCorner) {
  Random random(1);
  for (int k = 0; k < 500; ++k) {
    const double a = std::pow(10.0, random.between(-2, 2)),
                 b = std::pow(10.0, random.between(-2, 2)),
                 h = std::pow(10.0, random.between(-2, 2));
    const std::array<Point3, 4> rectangle{Point3(0, 0, h), {0, b, h}, {a, b, h}, {a, 0, h}};
    const double A = a / h, B = b / h, p = std::sqrt(1 + A * A), q = std::sqrt(1 + B * B);
    const double exact =
        (A / p * std::atan(B / p) + B / q * std::atan(A / q)) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(point_form_factor(Point3(0.0), {0, 0, 1}, rectangle), exact, 1e-12 * exact);
  }
}

// A point on the wall x = 0 at the end of a floor a x b that starts at height h below it:
// with X = a/b, Y = h/b,
//   F = 1/(2 pi) (atan(1/Y) - Y/sqrt(X^2+Y^2) atan(1/sqrt(X^2+Y^2))).
TEST(PointFormFactor, PerpendicularRectangle) {
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const double a = std::pow(10.0, random.between(-1, 2)),
                 b = std::pow(10.0, random.between(-1, 1)),
                 h = std::pow(10.0, random.between(-1, 1));
    const std::array<Point3, 4> floor{Point3(0, 0, -h), {a, 0, -h}, {a, b, -h}, {0, b, -h}};
    const double X = a / b, Y = h / b, r = std::hypot(X, Y);
    const double exact = (std::atan(1 / Y) - Y / r * std::atan(1 / r)) / (2.0 * std::numbers::pi);
    // Both sides subtract arcs of about 1.
    EXPECT_NEAR(point_form_factor(Point3(0.0), {1, 0, 0}, floor), exact, 1e-14 + 1e-12 * exact);
  }
}

TEST(PointFormFactor, TheWallsOfABoxFillTheHemisphere) {
  Scene scene;
  add_room(scene, {-1, -2, -3}, {2, 1, 0.5}, {});
  const SurfaceModel model = find_surfaces(scene);
  ASSERT_EQ(model.patches.size(), 6U);
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Point3 x = random.in_box({-1, -2, -3}, {2, 1, 0.5});
    const Direction n = random.direction();
    double sum = 0.0;
    for (const auto& patch : model.patches)
      sum += clipped_form_factor(x, n, polygon_of(patch));
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(PointFormFactor, AtAWallTheOthersFillTheHemisphere) {
  Scene scene;
  add_room(scene, Point3(0.0), Point3(1.0), {});
  const SurfaceModel model = find_surfaces(scene);
  Random random(4);
  for (int k = 0; k < 200; ++k) {
    double sum = 0.0;
    const Point3 x{random.between(0, 1), 0.0, random.between(0, 1)};
    for (const auto& patch : model.patches)
      if (model.surfaces[index(patch.surface)].plane.normal.y < 0.5)
        sum += clipped_form_factor(x, {0, 1, 0}, polygon_of(patch));
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(PointFormFactor, DoesNotDependOnScale) {
  const std::vector<Point3> polygon{{0.3, 0.1, 1.0}, {1.4, 0.2, 1.3}, {1.2, 1.1, 1.5}};
  const Direction n = glm::normalize(Vec3(0.1, 0.2, 1.0));
  const double at_one = point_form_factor(Point3(0.0), n, polygon);
  for (int power = -6; power <= 6; ++power) {
    std::vector<Point3> scaled;
    for (const auto& x : polygon)
      scaled.push_back(std::pow(10.0, power) * x);
    EXPECT_NEAR(point_form_factor(Point3(0.0), n, scaled), at_one, 1e-13 * at_one);
  }
}

// A polygon of 1e-9 sr is a direction: F = omega cos / pi, up to the square of its width, 1e-9.
TEST(PointFormFactor, TinyPolygonsAreSolidAngles) {
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const Direction to = random.direction(), n = random.direction();
    if (glm::dot(to, n) < 0.1)
      continue;
    const Vec3 u = glm::normalize(glm::cross(to, random.direction())), v = glm::cross(to, u);
    const double width = std::sqrt(1e-9), distance = random.between(0.1, 10.0);
    const Point3 c = distance * to;
    const std::array<Point3, 4> square{
        c + 0.5 * distance * width * (-u - v), c + 0.5 * distance * width * (u - v),
        c + 0.5 * distance * width * (u + v), c + 0.5 * distance * width * (v - u)};
    const double exact = 1e-9 * glm::dot(to, n) / std::numbers::pi;
    EXPECT_NEAR(point_form_factor(Point3(0.0), n, square), exact, 1e-8 * exact);
  }
}

TEST(PointFormFactor, DegeneratePolygonsBringNothing) {
  const Point3 x(0.0);
  const Direction n{0, 0, 1};
  EXPECT_EQ(point_form_factor(x, n, {}), 0.0);
  const std::array<Point3, 3> line{Point3(0, 0, 1), {1, 0, 1}, {2, 0, 1}};
  EXPECT_NEAR(point_form_factor(x, n, line), 0.0, 1e-15);
  const std::array<Point3, 3> at_the_point{Point3(0, 0, 0), {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(std::isfinite(point_form_factor(x, n, at_the_point)));
}

} // namespace
} // namespace meninas::test
