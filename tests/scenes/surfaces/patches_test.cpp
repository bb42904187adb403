#include "tests/scenes/soup.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <random>

namespace meninas::test {
namespace {

using Quad = std::array<Point3, 4>;

const Quad rectangle{Point3(0, 0, 0), {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
const Quad trapezoid{Point3(0, 0, 0), {3, 0, 0}, {2, 2, 0}, {0.5, 2, 0}};

SurfaceModel model_of(const Quad& quad, Diagonal diagonal = Diagonal::first_to_third) {
  Scene scene = empty_soup();
  add_quad(scene, quad, first_material, first_node, diagonal);
  SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  return model;
}

TEST(Patches, DoNotTellWhichDiagonalTheExporterChose) {
  for (const Quad& quad : {rectangle, trapezoid}) {
    const SurfaceModel one = model_of(quad, Diagonal::first_to_third);
    const SurfaceModel other = model_of(quad, Diagonal::second_to_fourth);
    ASSERT_EQ(one.patches.size(), 1u);
    ASSERT_EQ(other.patches.size(), 1u);
    EXPECT_EQ(one.patches[0].corners, quad);
    EXPECT_EQ(other.patches[0].corners, quad);
    EXPECT_EQ(one.patches[0].vertices, other.patches[0].vertices);
  }
}

TEST(Patches, OnlyParallelogramsAreAffine) {
  EXPECT_TRUE(model_of(rectangle).patches[0].affine);
  EXPECT_TRUE(model_of({Point3(0, 0, 0), {3, 0, 0}, {4, 2, 0}, {1, 2, 0}}).patches[0].affine);
  EXPECT_FALSE(model_of(trapezoid).patches[0].affine);
}

TEST(Patches, ConcaveAndNearlyStraightQuadsStayTriangles) {
  EXPECT_EQ(
      model_of({Point3(0, 0, 0), {3, 0, 0}, {0.5, 0.5, 0}, {0, 3, 0}}, Diagonal::first_to_third)
          .patches.size(),
      2u);
  // Three corners in a line, and 1e-4 beside it.
  EXPECT_EQ(model_of({Point3(0, 0, 0), {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}, Diagonal::second_to_fourth)
                .patches.size(),
            2u);
  EXPECT_EQ(
      model_of({Point3(0, 0, 0), {1, -1e-4, 0}, {2, 0, 0}, {0, 2, 0}}, Diagonal::second_to_fourth)
          .patches.size(),
      2u);
  // Convex enough.
  EXPECT_EQ(
      model_of({Point3(0, 0, 0), {1, -1e-2, 0}, {2, 0, 0}, {0, 2, 0}}, Diagonal::second_to_fourth)
          .patches.size(),
      1u);
}

TEST(Patches, BelongToOneNode) {
  Scene scene = empty_soup(1, 2);
  add_triangle(scene, {rectangle[0], rectangle[1], rectangle[2]}, first_material, NodeId{0});
  add_triangle(scene, {rectangle[0], rectangle[2], rectangle[3]}, first_material, NodeId{1});
  const SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  EXPECT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.patches.size(), 2u);
}

TEST(Patches, RectanglesThatShareOneDiagonalAllPair) {
  Scene scene = empty_soup();
  constexpr int sheets = 50;
  for (int half = 0; half < 2; ++half) {
    for (int k = 0; k < sheets; ++k) {
      const double turn = 3.0 * k / sheets;
      const Vec3 out(std::cos(turn), 0.0, std::sin(turn));
      const Point3 below(0, -1, 0);
      const Point3 above(0, 1, 0);
      if (half == 0) {
        add_triangle(scene, {below, above, Point3(out)});
      } else {
        add_triangle(scene, {above, below, Point3(-out)});
      }
    }
  }
  const SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  EXPECT_EQ(model.patches.size(), sheets);
  for (const Patch& patch : model.patches) {
    EXPECT_EQ(patch.corner_count, 4);
    EXPECT_TRUE(patch.affine);
  }
}

TEST(Patches, PreferTheRectanglesOfAGrid) {
  Scene scene = empty_soup();
  add_grid(scene, 9, 7, [](double u, double v) { return Point3(9.0 * u, 3.5 * v, 1.0); });
  const SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  ASSERT_EQ(model.patches.size(), 63u);
  for (const Patch& patch : model.patches) {
    EXPECT_EQ(patch.corner_count, 4);
    EXPECT_EQ(glm::dot(patch.corners[1] - patch.corners[0], patch.corners[3] - patch.corners[0]),
              0.0);
  }
}

TEST(Patches, LieInTheOrderOfTheirTriangles) {
  Scene scene = empty_soup();
  add_triangle(scene, {Point3(0, 0, 5), {1, 0, 5}, {0, 1, 5}});
  add_quad(scene, rectangle);
  add_triangle(scene, {Point3(0, 0, 7), {1, 0, 7}, {0, 1, 7}});
  const SurfaceModel model = find_surfaces(scene);
  const std::vector<PatchId> expected{PatchId{0}, PatchId{1}, PatchId{1}, PatchId{2}};
  EXPECT_EQ(model.patch_of_triangle, expected);
}

/// A patch over given corners, without a scene.
Patch patch_of(const std::vector<Point3>& corners) {
  Patch patch;
  patch.corner_count = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), patch.corners.begin());
  patch.affine = corners.size() == 3;
  return patch;
}

TEST(PatchMaps, CornersAndMiddle) {
  const Patch patch = patch_of({trapezoid.begin(), trapezoid.end()});
  EXPECT_EQ(point_at(patch, {0, 0}), trapezoid[0]);
  EXPECT_EQ(point_at(patch, {1, 0}), trapezoid[1]);
  EXPECT_EQ(point_at(patch, {1, 1}), trapezoid[2]);
  EXPECT_EQ(point_at(patch, {0, 1}), trapezoid[3]);
  EXPECT_EQ(point_at(patch, {0.5, 0.5}), Point3(1.375, 1.0, 0.0));
}

/// Largest error of uv_at(point_at(uv)) over a grid that includes the sides of the patch.
double inverse_error(const Patch& patch) {
  double worst = 0.0;
  const int steps = 16;
  for (int j = 0; j <= steps; ++j) {
    for (int i = 0; i <= steps; ++i) {
      const Vec2 uv(double(i) / steps, double(j) / steps);
      if (patch.corner_count == 3 && i + j > steps)
        continue;
      const Vec2 back = uv_at(patch, point_at(patch, uv));
      worst = std::max({worst, std::abs(back.x - uv.x), std::abs(back.y - uv.y)});
    }
  }
  return worst;
}

TEST(PatchMaps, AreInverse) {
  const glm::dmat3 rotation = oblique_rotation();
  for (const Quad& quad :
       {rectangle, trapezoid, Quad{Point3(0, 0, 0), {5, -1, 0}, {4, 3, 0}, {1, 7, 0}}}) {
    for (const double scale : {1e-6, 1.0, 1e6}) {
      std::vector<Point3> corners;
      for (const Point3& p : quad) {
        corners.push_back(scale * (rotation * p));
      }
      // Some ten roundings, of which each counts a few times in these shapes.
      EXPECT_LT(inverse_error(patch_of(corners)), 1e-14 * 10);
      corners.pop_back();
      EXPECT_LT(inverse_error(patch_of(corners)), 1e-14 * 10);
    }
  }
}

TEST(PatchMaps, AreInverseForAlmostParallelograms) {
  for (double deviation = 1.0; deviation > 1e-18; deviation *= 0.1) {
    for (const double sign : {-0.9, 0.9}) {
      const double d = sign * deviation;
      EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {3, 0, 0}, {3 + d, 2, 0}, {0, 2, 0}})), 1e-12)
          << d;
      EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {3, 0, 0}, {3, 2 + d, 0}, {0, 2, 0}})), 1e-12)
          << d;
      EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {3, 0, 0}, {3 + d, 2 + d, 0}, {d / 3, 2, 0}})),
                1e-12)
          << d;
    }
  }
}

TEST(PatchMaps, AreInverseForAlmostTriangles) {
  for (double width = 1.0; width > 1e-9; width *= 0.1) {
    // The short side stretches a rounding of the points by 1 / width in u, and the map turns points
    // near it back into lines.
    const double allowed = 1e-14 / width;
    EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {1, 0, 0}, {width, 1, 0}, {0, 1, 0}})), allowed)
        << width;
    EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {width, 0, 0}, {1, 1, 0}, {0, 1, 0}})), allowed)
        << width;
    EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0, 1, 0}})), allowed)
        << width;
    EXPECT_LT(inverse_error(patch_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, width, 0}})), allowed)
        << width;
  }
}

TEST(PatchMaps, StayInsideForPointsOutside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
  const std::vector<Patch> patches{patch_of({rectangle.begin(), rectangle.end()}),
                                   patch_of({trapezoid.begin(), trapezoid.end()}),
                                   patch_of({trapezoid.begin(), trapezoid.begin() + 3})};
  for (int k = 0; k < 3000; ++k) {
    const Point3 x(coordinate(random), coordinate(random), 0.0);
    for (const Patch& patch : patches) {
      const Vec2 uv = uv_at(patch, x);
      ASSERT_TRUE(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0) << uv.x << ' ' << uv.y;
      // 1 - u may round up by half a unit.
      ASSERT_TRUE(patch.corner_count == 4 || uv.x + uv.y <= 1.0 + 2e-16);
    }
  }
}

TEST(PatchMaps, BarycentricsFindThePoint) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Scene scene = empty_soup();
  for (const double z : {0.0, 1.0}) {
    const Vec3 up(0, 0, z);
    add_quad(scene, {rectangle[0] + up, rectangle[1] + up, rectangle[2] + up, rectangle[3] + up});
    add_quad(scene,
             {trapezoid[0] - up - 5.0 * up, trapezoid[1] - 6.0 * up, trapezoid[2] - 6.0 * up,
              trapezoid[3] - 6.0 * up},
             first_material, first_node, Diagonal::second_to_fourth);
    add_triangle(scene, {Point3(0, 0, 9 + z), {1, 0, 9 + z}, {0, 1, 9 + z}});
  }
  const SurfaceModel model = find_surfaces(scene);
  for (int k = 0; k < 2000; ++k) {
    const auto triangle =
        static_cast<TriangleId>(static_cast<std::size_t>(k) % scene.triangles.size());
    Vec2 b(unit(random), unit(random));
    b = b.x + b.y > 1.0 ? Vec2(1.0) - b : b;
    const auto p = corners(scene, triangle);
    const Point3 expected = (1.0 - b.x - b.y) * p[0] + b.x * p[1] + b.y * p[2];
    const Patch& patch = model.patches[index(model.patch_of_triangle[index(triangle)])];
    // Coordinates up to 10, a few roundings of each.
    EXPECT_LT(glm::distance(point_at(patch, patch_uv(model, triangle, b)), expected), 1e-14);
  }
}

} // namespace
} // namespace meninas::test
