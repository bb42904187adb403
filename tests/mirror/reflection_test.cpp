#include "mirror/reflection.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// A few roundings of numbers of size ten, each 1e-16 of its size.
constexpr double rounding = 1e-13;

Plane random_plane(Random& random) { return {random.direction(), random.between(-3.0, 3.0)}; }

TEST(Reflection, KnownPlane) {
  const Plane mirror{{0.0, 1.0, 0.0}, 2.0};
  EXPECT_EQ(reflect_point(mirror, {3.0, 5.0, -1.0}), Point3(3.0, -1.0, -1.0));
  EXPECT_EQ(reflect_direction(mirror, {0.6, 0.8, 0.0}), Direction(0.6, -0.8, 0.0));
}

TEST(Reflection, TwiceIsNothing) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const Plane mirror = random_plane(random);
    const Point3 x = random.in_box(Vec3(-10.0), Vec3(10.0));
    const Direction d = random.direction();
    EXPECT_LT(glm::distance(reflect_point(mirror, reflect_point(mirror, x)), x), rounding);
    EXPECT_LT(glm::distance(reflect_direction(mirror, reflect_direction(mirror, d)), d), rounding);
  }
}

TEST(Reflection, PointsOfTheMirrorStay) {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const Plane mirror = random_plane(random);
    Point3 x = random.in_box(Vec3(-10.0), Vec3(10.0));
    x -= signed_distance(mirror, x) * mirror.normal;
    EXPECT_LT(glm::distance(reflect_point(mirror, x), x), rounding);
  }
}

TEST(Reflection, PlanesKeepTheirDistances) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const Plane mirror = random_plane(random), plane = random_plane(random);
    const Point3 x = random.in_box(Vec3(-10.0), Vec3(10.0));
    const Plane image = reflect_plane(mirror, plane);
    EXPECT_NEAR(signed_distance(image, reflect_point(mirror, x)), signed_distance(plane, x),
                rounding);
    EXPECT_NEAR(glm::length(image.normal), 1.0, rounding);
  }
}

TEST(Isometry, ComposesFromTheInside) {
  Random random(4);
  for (int k = 0; k < 100; ++k) {
    const Plane m1 = random_plane(random), m2 = random_plane(random), m3 = random_plane(random);
    const Isometry map = compose_reflection(compose_reflection(compose_reflection({}, m1), m2), m3);
    const Point3 x = random.in_box(Vec3(-10.0), Vec3(10.0));
    EXPECT_LT(
        glm::distance(apply(map, x), reflect_point(m1, reflect_point(m2, reflect_point(m3, x)))),
        rounding);
    const Plane plane = random_plane(random);
    const Plane expected = reflect_plane(m1, reflect_plane(m2, reflect_plane(m3, plane)));
    EXPECT_LT(glm::distance(apply(map, plane).normal, expected.normal), rounding);
    EXPECT_NEAR(apply(map, plane).offset, expected.offset, rounding);
  }
}

TEST(Isometry, LongChainsKeepDistancesAndHandedness) {
  Random random(5);
  Isometry map;
  const Point3 a{1.0, 2.0, 3.0}, b{-2.0, 0.5, 1.0};
  for (int depth = 1; depth <= 60; ++depth) {
    map = compose_reflection(map, random_plane(random));
    // Every reflection adds its rounding, which grows with how far out the image lies: some 200 m.
    const double error = 1e-14 * depth * 200.0;
    EXPECT_NEAR(glm::distance(apply(map, a), apply(map, b)), glm::distance(a, b), error);
    EXPECT_NEAR(glm::determinant(map.linear), depth % 2 == 0 ? 1.0 : -1.0, error);
  }
}

TEST(Isometry, ParallelMirrorsTranslateByTwiceTheirDistance) {
  const Plane left{{1.0, 0.0, 0.0}, 0.0}, right{{-1.0, 0.0, 0.0}, -1.5};
  Isometry map;
  for (int pairs = 1; pairs <= 20; ++pairs) {
    map = compose_reflection(compose_reflection(map, right), left);
    const Point3 image = apply(map, {0.25, 0.5, 0.75});
    EXPECT_LT(glm::distance(image, Point3(0.25 + 3.0 * pairs, 0.5, 0.75)), rounding);
  }
}

} // namespace
} // namespace meninas::test
