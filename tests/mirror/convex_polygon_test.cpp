#include "mirror/convex_polygon.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// Of areas of about one, after a handful of roundings.
constexpr double rounding = 1e-12;

double area(const ConvexPolygon& polygon) { return glm::length(area_vector(polygon.span())); }

ConvexPolygon quad(const Point3& corner, const Vec3& u, const Vec3& v) {
  return ConvexPolygon(std::array<Point3, 4>{corner, corner + u, corner + u + v, corner + v});
}

/// Corners in order on an ellipse in a random plane.
ConvexPolygon random_polygon(Random& random, std::size_t corners) {
  const Direction normal = random.direction();
  const Vec3 a = glm::normalize(glm::cross(normal, random.direction())), b = glm::cross(normal, a);
  const Point3 centre = random.in_box(Vec3(-1.0), Vec3(1.0));
  const double width = random.between(0.05, 2.0);
  std::vector<double> angles;
  for (std::size_t k = 0; k < corners; ++k)
    angles.push_back(random.between(0.0, 2.0 * std::numbers::pi));
  std::sort(angles.begin(), angles.end());
  ConvexPolygon polygon;
  for (const double t : angles)
    polygon.push_back(centre + width * std::cos(t) * a + std::sin(t) * b);
  return polygon;
}

/// Every corner turns the same way, up to rounding.
bool is_convex(const ConvexPolygon& polygon, const Direction& normal) {
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const Point3& a = polygon.vertices[k];
    const Point3& b = polygon.vertices[(k + 1) % polygon.size];
    const Point3& c = polygon.vertices[(k + 2) % polygon.size];
    if (glm::dot(glm::cross(b - a, c - b), normal) < -rounding)
      return false;
  }
  return true;
}

TEST(ClipPolygon, InPlaceIsTheSame) {
  Random random(11);
  int cut = 0;
  for (int k = 0; k < 2000; ++k) {
    const ConvexPolygon polygon = random_polygon(random, 3 + static_cast<std::size_t>(k) % 10);
    const Point3 origin = random.in_box(Vec3(-2.0), Vec3(2.0));
    const Vec3 normal = random.direction();
    ConvexPolygon above = polygon;
    clip_in_place(above, origin, normal);
    const ConvexPolygon expected = clip(polygon, origin, normal);
    EXPECT_TRUE(std::ranges::equal(above.span(), expected.span()));
    cut += expected.empty() || std::ranges::equal(expected.span(), polygon.span()) ? 0 : 1;
  }
  EXPECT_GT(cut, 200);
}

TEST(ClipPolygon, PartAndComplementMakeTheWhole) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const ConvexPolygon polygon = random_polygon(random, 3 + static_cast<std::size_t>(k) % 10);
    const Vec3 whole = area_vector(polygon.span());
    const Point3 origin = random.in_box(Vec3(-1.0), Vec3(1.0));
    const Vec3 normal = random.between(0.1, 10.0) * random.direction();
    const ConvexPolygon part = clip(polygon, origin, normal), rest = clip(polygon, origin, -normal);
    EXPECT_LT(glm::distance(area_vector(part.span()) + area_vector(rest.span()), whole), rounding);
    for (const auto& x : part.span())
      EXPECT_GE(glm::dot(normal, x - origin), -1e-13);
    EXPECT_TRUE(is_convex(part, glm::normalize(whole)));
    EXPECT_LE(part.size, polygon.size + 1);
  }
}

TEST(ClipPolygon, KnownHalf) {
  const ConvexPolygon square = quad(Point3(0.0), {2.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  const ConvexPolygon part = clip(square, {0.5, 0.0, 0.0}, {-1.0, 0.0, 0.0});
  EXPECT_NEAR(area(part), 0.5, rounding);
  EXPECT_EQ(part.size, 4U);
}

TEST(ClipPolygon, TouchingPlanes) {
  const ConvexPolygon square = quad(Point3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  // Along an edge, from both sides.
  EXPECT_NEAR(area(clip(square, Point3(0.0), {1.0, 0.0, 0.0})), 1.0, 0.0);
  EXPECT_TRUE(clip(square, Point3(0.0), {-1.0, 0.0, 0.0}).empty());
  // Through one corner.
  EXPECT_NEAR(area(clip(square, Point3(0.0), {1.0, 1.0, 0.0})), 1.0, 0.0);
  EXPECT_TRUE(clip(square, Point3(0.0), {-1.0, -1.0, 0.0}).empty());
  // Along the diagonal: the cut meets corners, no edge.
  const ConvexPolygon triangle = clip(square, Point3(0.0), {1.0, -1.0, 0.0});
  EXPECT_EQ(triangle.size, 3U);
  EXPECT_NEAR(area(triangle), 0.5, rounding);
}

TEST(ClipPolygon, PolygonInThePlaneIsOnItsPositiveSide) {
  const ConvexPolygon square = quad(Point3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_NEAR(area(clip(square, Point3(0.0), {0.0, 0.0, 1.0})), 1.0, 0.0);
}

TEST(ClipPolygon, EmptyStaysEmpty) {
  EXPECT_TRUE(clip({}, Point3(0.0), {1.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(clip_to_cone({}, Point3(0.0), quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0})).empty());
  EXPECT_TRUE(clip_to_cone(quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), Point3(0.0), ConvexPolygon()).empty());
}

TEST(ClipPolygon, BeyondItsCapacityItErrsOnTheLargeSide) {
  // The disc cut by its own tangents, twice as many as there is room for.
  constexpr int tangents = 96;
  ConvexPolygon part = quad({-2.0, -2.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
  for (int k = 0; k < tangents; ++k) {
    const double t = 2.0 * std::numbers::pi * (7 * k % tangents) / tangents;
    const Vec3 outward(std::cos(t), std::sin(t), 0.0);
    part = clip(part, outward, -outward);
    ASSERT_LE(part.size, ConvexPolygon::capacity);
  }
  const double exact = tangents * std::tan(std::numbers::pi / tangents);
  EXPECT_GE(area(part), exact - rounding);
  // A polygon of 47 corners around the disc is 0.2 % larger than the disc;
  // twice that is room enough.
  EXPECT_LT(area(part), 1.01 * exact);
}

TEST(ClipToCone, PartsOfTheWindowAddUp) {
  Random random(2);
  for (int k = 0; k < 500; ++k) {
    const Point3 apex = random.in_box({-1, -1, -3}, {1, 1, -1});
    const Vec3 u = random.in_box({0.5, -0.2, -0.2}, {1.0, 0.2, 0.2});
    const Vec3 v = random.in_box({-0.2, 0.5, -0.2}, {0.2, 1.0, 0.2});
    const Point3 corner = random.in_box({-0.7, -0.7, -0.1}, {0.0, 0.0, 0.1});
    const ConvexPolygon target = quad({-3, -3, 2}, {6, 0, 0.5}, {0, 6, -0.5});
    const double whole = area(clip_to_cone(target, apex, quad(corner, u, v)));
    const double s = random.between(0.1, 0.9), t = random.between(0.1, 0.9);
    double sum = 0.0;
    for (const auto& [s0, s1] : {std::pair(0.0, s), std::pair(s, 1.0)})
      for (const auto& [t0, t1] : {std::pair(0.0, t), std::pair(t, 1.0)})
        sum += area(clip_to_cone(target, apex,
                                 quad(corner + s0 * u + t0 * v, (s1 - s0) * u, (t1 - t0) * v)));
    EXPECT_NEAR(sum, whole, 40.0 * rounding); // of an area of up to 36
    // Either way round the window is the same.
    EXPECT_NEAR(area(clip_to_cone(target, apex, quad(corner, v, u))), whole, 40.0 * rounding);
  }
}

TEST(ClipToCone, ShadowOfAWindow) {
  // From height 1 below the window, a target at height 2 below shows it twice as large.
  const ConvexPolygon window = quad({-0.5, -0.5, 1.0}, {1, 0, 0}, {0, 1, 0});
  const ConvexPolygon far = quad({-5, -5, 2}, {10, 0, 0}, {0, 10, 0});
  const ConvexPolygon near = quad({-5, -5, 0.5}, {10, 0, 0}, {0, 10, 0});
  EXPECT_NEAR(area(clip_to_cone(far, Point3(0.0), window)), 4.0, rounding);
  // The cone goes on on both sides of the window, but not behind the apex.
  EXPECT_NEAR(area(clip_to_cone(near, Point3(0.0), window)), 0.25, rounding);
  EXPECT_TRUE(
      clip_to_cone(quad({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}), Point3(0.0), window).empty());
}

TEST(ClipToCone, ApexInThePlaneOfTheWindowSeesNothing) {
  const ConvexPolygon window = quad({0.0, 0.0, 0.0}, {1, 0, 0}, {0, 1, 0});
  const ConvexPolygon target = quad({-5, -5, 2}, {10, 0, 0}, {0, 10, 0});
  EXPECT_TRUE(clip_to_cone(target, {2.0, 0.0, 0.0}, window).empty());
  EXPECT_TRUE(clip_to_cone(target, {0.5, 0.5, 0.0}, window).empty());
}

// What is left of a window that another only touches: corners that rounding holds apart.
TEST(ClipToCone, NothingIsSeenThroughAPoint) {
  const Point3 apex(0.1, 0.2, 0.0), at(0.3, 0.4, 1.0);
  const Vec3 x(2e-16, 0.0, 0.0), y(0.0, 2e-16, 0.0);
  const ConvexPolygon point(std::array{at, at + x, at + x + y});
  const Vec3 u(5.0, 0.0, 0.0), v(0.0, 5.0, 0.0);
  const Point3 corner(-2.0, -2.0, 2.0);
  const ConvexPolygon wall(std::array{corner, corner + u, corner + u + v, corner + v});
  EXPECT_TRUE(is_point(point, apex));
  EXPECT_TRUE(clip_to_cone(wall, apex, point).empty());
  EXPECT_FALSE(is_point(wall, apex));
  EXPECT_FALSE(
      clip_to_cone(wall, apex, ConvexPolygon(std::array{at, at + 0.1 * u, at + 0.1 * v})).empty());
}

TEST(ClipToCone, TouchingConesShareNoArea) {
  const ConvexPolygon window = quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  const ConvexPolygon beside = quad({2, 0, 2}, {2, 0, 0}, {0, 2, 0});
  EXPECT_TRUE(clip_to_cone(beside, Point3(0.0), window).empty());
}

} // namespace
} // namespace meninas::test
