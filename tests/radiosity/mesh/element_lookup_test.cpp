#include "radiosity/mesh/element_lookup.h"
#include "radiosity/mesh/make_mesh.h"
#include "radiosity/scene/plan.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas {
namespace {

/// The landing table of one quad in a tilted plane:
/// its corners in the order given, in metres along two directions.
struct QuadWorld {
  Scene scene;
  SurfaceModel surfaces;
  ElementLookup table;

  explicit QuadWorld(const std::vector<Vec2>& corners) {
    const Vec3 along = glm::normalize(Vec3(1.0, 0.3, -0.2));
    const Vec3 across = glm::normalize(glm::cross(Vec3(0.2, 1.0, 0.7), along));
    std::vector<Point3> points;
    for (const Vec2& corner : corners)
      points.push_back(Point3(1.0, 2.0, 3.0) + corner.x * along + corner.y * across);
    test::add_polygon(scene, "quad", points, test::diffuse(0.5));
    surfaces = find_surfaces(scene);
    const MirrorSet mirrors = plan_transport(scene, surfaces).mirrors;
    const ElementMesh mesh = make_element_mesh(scene, surfaces, MeshSettings{});
    table = make_element_lookup(scene, surfaces, mirrors, mesh, {1.0, 2.0, 3.0}, 1.0);
  }
};

/// The largest difference between the single-precision map and the one of the patch.
double largest_error(const QuadWorld& world) {
  test::Random random(11);
  double error = 0.0;
  for (std::uint32_t t = 0; t < world.scene.triangles.size(); ++t)
    for (int n = 0; n < 2000; ++n) {
      double b1 = random.between(0.0, 1.0), b2 = random.between(0.0, 1.0);
      if (b1 + b2 > 1.0)
        b1 = 1.0 - b1, b2 = 1.0 - b2;
      const auto f1 = static_cast<float>(b1), f2 = static_cast<float>(b2);
      const Vec2 exact = patch_uv(world.surfaces, TriangleId{t}, Vec2(f1, f2));
      const Vec2 found(hit_uv(world.table.faces[2 * t], world.surfaces, t, f1, f2));
      error = std::max({error, std::abs(exact.x - found.x), std::abs(exact.y - found.y)});
    }
  return error;
}

// The product of the conditions that widening_of asks for,
// 1 / 0.1 and 4, times a few roundings of floats
constexpr double float_error = 10.0 * 4.0 * 6e-8 * 4.0;

TEST(Landing, ParallelogramsAreAffine) {
  const QuadWorld world({{0, 0}, {2, 0.5}, {2.5, 1.5}, {0.5, 1}});
  ASSERT_EQ(world.table.faces[0].map, UvMap::affine);
  EXPECT_LT(largest_error(world), 1e-6);
}

TEST(Landing, QuadsOfOtherShapesAreSolvedInSinglePrecision) {
  const std::vector<std::vector<Vec2>> quads{
      {{0, 0}, {5.528, 0}, {5.496, 5.592}, {0, 5.592}}, // the floor of the Cornell box
      {{0, 0}, {4, 0}, {3, 1}, {1, 1}},                 // a trapezium
      {{0, 0}, {1, 0}, {2.5, 1}, {-1, 1}},              // that widens
      {{0, 0}, {1, 0}, {1.4, 1.7}, {-0.2, 0.8}},        // no two sides parallel
      {{0, 0}, {3, 0.2}, {2.2, 1.1}, {0.4, 1.9}}};
  for (std::size_t q = 0; q < quads.size(); ++q) {
    const QuadWorld world(quads[q]);
    ASSERT_EQ(world.table.faces[0].map, UvMap::bilinear) << q;
    EXPECT_LT(largest_error(world), float_error) << q;
  }
}

TEST(Landing, NearlyVanishingSidesAreLeftToThePatch) {
  const QuadWorld world({{0, 0}, {4, 0}, {2.1, 1}, {1.9, 1}});
  ASSERT_EQ(world.table.faces[0].map, UvMap::general);
  EXPECT_LT(largest_error(world), 1e-6);
}

} // namespace
} // namespace meninas
