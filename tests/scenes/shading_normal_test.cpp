#include "scenes/shading_normal.h"

#include "scenes/rays/curved_origin.h"
#include "tests/support/globes.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

Scene globe(GivenNormals normals, bool hollow = false) {
  Scene scene;
  add_globe(scene, "globe", {.hollow = hollow}, diffuse(0.5), normals);
  return scene;
}

/// Calls visit(triangle, barycentric) for some points of every triangle.
template <typename Visit>
void for_each_point(const Scene& scene, const Visit& visit) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (const Vec2 b : {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.5, 0.5),
                         Vec2(1.0 / 3.0, 1.0 / 3.0), Vec2(0.1, 0.2)})
      visit(TriangleId{t}, b);
}

Point3 flat_point(const Scene& scene, TriangleId triangle, Vec2 b) {
  const auto p = corners(scene, triangle);
  return (1.0 - b.x - b.y) * p[0] + b.x * p[1] + b.y * p[2];
}

// Between the ends of an arc of 15 degrees, linear interpolation turns the direction by
// at most h^2 / 8 of the ends' difference h = 0.26 from that of the point on the chord.
TEST(ShadingNormal, IsThatOfTheSphere) {
  const Scene scene = globe(GivenNormals::smooth);
  constexpr double step = std::numbers::pi / 12.0;
  for_each_point(scene, [&](TriangleId triangle, Vec2 b) {
    const Direction n = shading_normal(scene, triangle, b),
                    exact = glm::normalize(flat_point(scene, triangle, b));
    EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
    EXPECT_LT(glm::distance(n, exact), step * step / 8.0);
  });
}

TEST(ShadingNormal, OfTheBackOfAHollowSphereLooksInwards) {
  const Scene scene = globe(GivenNormals::smooth, true);
  for_each_point(scene, [&](TriangleId triangle, Vec2 b) {
    EXPECT_LT(glm::dot(shading_normal(scene, triangle, b), flat_point(scene, triangle, b)), -0.9);
  });
}

TEST(ShadingNormal, OfFlatFacetsIsTheirOwn) {
  for (const GivenNormals normals : {GivenNormals::none, GivenNormals::flat}) {
    const Scene scene = globe(normals);
    for_each_point(scene, [&](TriangleId triangle, Vec2 b) {
      EXPECT_FALSE(scene.triangles[index(triangle)].curved);
      const Direction face = glm::normalize(area_vector(corners(scene, triangle)));
      EXPECT_LT(glm::distance(shading_normal(scene, triangle, b), face), 1e-15);
    });
  }
}

/// A triangle with a normal at each corner.
Scene triangle_with(const std::array<Vec3, 3>& normals, double error = 0.0) {
  Scene scene;
  add_polygon(scene, "triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.5));
  for (std::size_t k = 0; k < 3; ++k)
    scene.vertices[k].normal = glm::vec3(normals[k]);
  mark_curved(scene, TriangleId{0}, error);
  return scene;
}

TEST(ShadingNormal, RoundingOfTheFileIsNoCurve) {
  const Vec3 up(0, 0, 1), tilted = glm::normalize(Vec3(0.005, 0, 1));
  EXPECT_TRUE(triangle_with({up, tilted, up}).triangles[0].curved);
  EXPECT_FALSE(triangle_with({up, glm::normalize(Vec3(5e-4, 0, 1)), up}).triangles[0].curved);
  // Half a step of eight bits along two axes.
  EXPECT_FALSE(triangle_with({up, tilted, up}, std::sqrt(0.5) / 127.0).triangles[0].curved);
}

TEST(ShadingNormal, OnesBehindTheFaceSayNothing) {
  const Vec3 up(0, 0, 1), aside = glm::normalize(Vec3(1, 0, 1));
  const Scene one = triangle_with({aside, -aside, up});
  EXPECT_EQ(corner_normals(one, TriangleId{0})[1], up);
  EXPECT_LT(glm::distance(corner_normals(one, TriangleId{0})[0], aside), 1e-6);
  // Where all are behind, the triangle is wound the other way.
  const Scene all = triangle_with({-aside, -up, -up});
  EXPECT_LT(glm::distance(corner_normals(all, TriangleId{0})[0], aside), 1e-6);
  // Zero stands for what the file does not say.
  EXPECT_FALSE(triangle_with({Vec3(0.0), up, Vec3(0.0)}).triangles[0].curved);
}

TEST(ShadingNormal, NeverReflectsBelowTheFace) {
  Random random(7);
  const Direction face(0.0, 0.0, 1.0);
  int bent = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto above = [&] {
      const Direction d = random.direction();
      return glm::normalize(Vec3(d.x, d.y, std::max(std::abs(d.z), 1e-4)));
    };
    const Direction normal = above(), out = above();
    const Direction n = visible_normal(normal, face, out);
    EXPECT_NEAR(glm::length(n), 1.0, 1e-12);
    EXPECT_GT(glm::dot(n, out), 0.0);
    const Direction reflected = 2.0 * glm::dot(n, out) * n - out;
    EXPECT_GT(reflected.z, 0.0);
    const Direction asked = 2.0 * glm::dot(normal, out) * normal - out;
    const bool fine = glm::dot(normal, out) > 0.0 && asked.z > 0.01;
    bent += fine ? 0 : 1;
    EXPECT_TRUE(!fine || n == normal);
  }
  EXPECT_GT(bent, 1000);
}

// Over the chord of an arc of half-angle a, the point is twice as high as the arc, which is
// at most 1 - cos(a) above it; a facet has arcs of 15 degrees both ways.
TEST(ShadingNormal, LightIsLookedForOverTheCurve) {
  const Scene scene = globe(GivenNormals::smooth), hollow = globe(GivenNormals::smooth, true);
  constexpr double arc = 1.0 - 0.9914448613738104; // cos(7.5 degrees)
  for_each_point(scene, [&](TriangleId triangle, Vec2 b) {
    const double height = glm::length(point_on_curve(scene, triangle, b, true));
    EXPECT_GE(height, 1.0 - 1e-12);
    EXPECT_LE(height, 1.0 + 2.0 * 2.0 * arc);
    EXPECT_EQ(point_on_curve(scene, triangle, b, false), flat_point(scene, triangle, b));
  });
  for_each_point(hollow, [&](TriangleId triangle, Vec2 b) {
    EXPECT_EQ(point_on_curve(hollow, triangle, b, true), flat_point(hollow, triangle, b));
  });
}

// A wall that touches the globe is between its facets and their curve: light behind is not seen.
TEST(CurvedOrigin, StaysOnItsSideOfAWall) {
  Scene scene = globe(GivenNormals::smooth);
  const double beyond = 0.999; // within the height of the curve, where a meridian is
  add_polygon(scene, "wall", {{beyond, -3, -3}, {beyond, 3, -3}, {beyond, 3, 3}, {beyond, -3, 3}},
              double_sided(diffuse(0.5)));
  const SurfaceModel surfaces = find_surfaces(scene);
  const RayScene rays = make_ray_scene(scene, surfaces);
  for_each_point(scene, [&](TriangleId triangle, Vec2 b) {
    const bool before = flat_point(scene, triangle, b).x < beyond - 1e-6;
    if (scene.triangles[index(triangle)].curved && before) {
      EXPECT_LT(curved_origin(scene, surfaces, rays, triangle, b, true).x, beyond);
    }
  });
}

TEST(ShadingNormal, LobesKeepWhatWouldGoBelowTheFace) {
  const Direction face(0.0, 0.0, 1.0);
  EXPECT_EQ(kept_above({0.6, 0.0, 0.8}, face), Direction(0.6, 0.0, 0.8));
  EXPECT_EQ(kept_above({0.6, 0.0, -0.8}, face), Direction(0.6, 0.0, 0.8));
}

} // namespace
} // namespace meninas::test
