// The way into planes, in closed form.
#include "scenes/repair/common_place.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace meninas::test {
namespace {

Plane plane(const Vec3& normal, double offset) { return {glm::normalize(normal), offset}; }

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(glm::distance(a, b), 0.0, 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(CommonPlace, OfOnePlaneIsItsFoot) {
  const std::array planes{plane({0, 0, 2}, 5.0)};
  expect_near(way_into({1, 2, 3}, planes), {0, 0, 2});
}

TEST(CommonPlace, OfTwoPlanesIsOnTheirLine) {
  const std::array planes{plane({1, 0, 0}, 4.0), plane({1, 1, 0}, 0.0)};
  expect_near(way_into({1, 2, 3}, planes), {3, -6, 0});
}

TEST(CommonPlace, OfThreePlanesAndMoreIsTheirCorner) {
  const std::array planes{plane({1, 0, 0}, 4.0), plane({0, 1, 0}, 5.0), plane({0, 0, -1}, 6.0),
                          plane({1, 0, 0}, 4.0)};
  expect_near(way_into({1, 2, 3}, planes), {3, 3, -9});
}

TEST(CommonPlace, OfNearlyOnePlaneIsNearby) {
  // Two planes a hundredth apart in their normals meet ten metres away.
  const std::array planes{plane({0, 0, 1}, 0.0), plane({0.01, 0, 1}, 0.1)};
  EXPECT_LT(glm::length(way_into({0, 0, 0}, planes)), 0.1);
}

TEST(CommonPlace, OfPlanesAThirdOfARadianApartIsOnTheirLine) {
  // The smaller singular value is sin(a / 2) of the two, the larger cos(a / 2): 0.15 of it here, above 0.05.
  const double angle = 0.3;
  const std::array planes{plane({0, 0, 1}, 0.0), plane({std::sin(angle), 0, std::cos(angle)}, 0.1)};
  expect_near(way_into({0, 0, 0}, planes), {0.1 / std::sin(angle), 0, 0});
}

TEST(CommonPlace, OfPlanesAnEightiethOfATurnApartIsBetweenThem) {
  // 0.04 of the larger singular value: one plane, whose place is the mean of the two.
  const double angle = 0.08;
  const std::array planes{plane({0, 0, 1}, 0.0), plane({std::sin(angle), 0, std::cos(angle)}, 0.1)};
  EXPECT_LT(glm::length(way_into({0, 0, 0}, planes)), 0.1);
}

TEST(CommonPlace, OfWhatOverflowsIsNowhere) {
  const std::array planes{plane({0, 0, 1}, 0.0)};
  const Vec3 way = way_into({0, 0, 1e200}, planes);
  EXPECT_TRUE(std::isfinite(way.x) && std::isfinite(way.y) && std::isfinite(way.z));
}

} // namespace
} // namespace meninas::test
