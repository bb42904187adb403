// Grids of measuring points, and the light at them.
#include "radiosity/queries/measuring_grid.h"
#include "scenes/errors.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

// 0.2 * 5^log10(d): the values of EN 12464-1 for 1, 5 and 10 m, of its table of rounded ones.
TEST(MeasuringGrid, SpacingOfTheStandard) {
  EXPECT_NEAR(grid_spacing(1.0, 0.8), 0.2, 1e-12);
  EXPECT_NEAR(grid_spacing(5.0, 4.0), 0.6, 0.02);
  EXPECT_NEAR(grid_spacing(10.0, 8.0), 1.0, 1e-12);
  EXPECT_NEAR(grid_spacing(8.0, 10.0), 1.0, 1e-12);
  EXPECT_NEAR(grid_spacing(20.0, 10.0), 1.0, 1e-12) << "half as long: by the shorter side";
  EXPECT_EQ(grid_spacing(1e5, 1e5), 10.0);
}

Scene table() {
  Scene scene;
  add_polygon(scene, "desk", {{0, 1, 2}, {3, 1, 2}, {3, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  return scene;
}

TEST(MeasuringGrid, PointsStandInTheMiddleOfCells) {
  const Scene scene = table();
  const auto grids = measuring_grids(scene, find_surfaces(scene), "desk", {.margin = 0.5, .height = 0.25});
  ASSERT_EQ(grids.size(), 1U);
  const MeasuringGrid& grid = grids.front();
  // 2 x 1 m within the margin: by the shorter side, p = 0.2, five across and ten along.
  EXPECT_NEAR(grid.length, 2.0, 1e-12);
  EXPECT_NEAR(grid.width, 1.0, 1e-12);
  EXPECT_EQ(grid.along, 10U);
  EXPECT_EQ(grid.across, 5U);
  ASSERT_EQ(grid.points.size(), 50U);
  Vec3 low(1e9), high(-1e9);
  for (const QueryPoint& point : grid.points) {
    EXPECT_EQ(point.normal, Vec3(0, 1, 0));
    low = glm::min(low, point.position);
    high = glm::max(high, point.position);
  }
  EXPECT_LT(glm::distance(low, Vec3(0.6, 1.25, 0.6)), 1e-12);
  EXPECT_LT(glm::distance(high, Vec3(2.4, 1.25, 1.4)), 1e-12);
}

// An L of two squares that stand apart by a third of the square around them.
TEST(MeasuringGrid, PointsBesideTheFaceAreLeftOut) {
  Scene scene = table();
  scene.triangles.clear();
  add_polygon(scene, "unused", {{0, 9, 2}, {3, 9, 2}, {3, 9, 0}, {0, 9, 0}}, diffuse(0.5));
  const NodeId node = add_polygon(scene, "ell", {{0, 0, 2}, {2, 0, 2}, {2, 0, 1}, {0, 0, 1}}, diffuse(0.5));
  const std::size_t first = scene.triangles.size();
  add_polygon(scene, "ell2", {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, diffuse(0.5));
  for (std::size_t t = first; t < scene.triangles.size(); ++t) {
    scene.triangles[t].node = node;
    scene.triangles[t].material = scene.triangles[first - 1].material;
  }
  const auto grids = measuring_grids(scene, find_surfaces(scene), "ell", {});
  std::size_t points = 0, cells = 0;
  for (const MeasuringGrid& grid : grids) {
    points += grid.points.size();
    cells += grid.along * grid.across;
    for (const QueryPoint& point : grid.points)
      EXPECT_FALSE(point.position.x > 1.0 && point.position.z < 1.0);
  }
  EXPECT_GT(points, 0U);
  // One surface: three quarters of its square. Two: all of both.
  EXPECT_TRUE(grids.size() == 2 ? points == cells : std::abs(double(points) - 0.75 * double(cells)) <= 0.15 * double(cells));
}

TEST(MeasuringGrid, BothSidesOfASheet) {
  Scene scene;
  add_polygon(scene, "sheet", {{0, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0}}, double_sided(diffuse(0.5)));
  const auto grids = measuring_grids(scene, find_surfaces(scene), "sheet", {.height = 0.1});
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_FALSE(grids[0].back);
  EXPECT_TRUE(grids[1].back);
  EXPECT_NEAR(grids[0].points.front().position.y, 1.1, 1e-12);
  EXPECT_NEAR(grids[1].points.front().position.y, 0.9, 1e-12);
  EXPECT_EQ(grids[1].points.front().normal, Vec3(0, -1, 0));
}

TEST(MeasuringGrid, BadQuestions) {
  const Scene scene = table();
  const auto surfaces = find_surfaces(scene);
  EXPECT_THROW(measuring_grids(scene, surfaces, "dusk", {}), UsageError);
  EXPECT_THROW(measuring_grids(scene, surfaces, "desk", {.margin = 1.0}), UsageError);
}

Scene as_one_node(Scene scene, const std::string& name) {
  scene.nodes[0].name = name;
  for (Triangle& triangle : scene.triangles) {
    triangle.node = NodeId{0};
    triangle.material = MaterialId{0};
  }
  return scene;
}

TEST(MeasuringGrid, FacesNarrowerThanTheMarginHaveNone) {
  Scene scene;
  add_box(scene, "desk", {0.0, 0.7, 0.0}, {1.6, 0.725, 0.8}, diffuse(0.5));
  const Scene desk = as_one_node(std::move(scene), "desk");
  EXPECT_EQ(measuring_grids(desk, find_surfaces(desk), "desk", {.margin = 0.1}).size(), 2U);
  EXPECT_THROW(measuring_grids(desk, find_surfaces(desk), "desk", {.margin = 0.5}), UsageError);
}

// What a margin leaves by rounding is a strip that is 1e22 times as long as wide.
TEST(MeasuringGrid, MorePointsThanThereAreNumbersAreRefused) {
  Scene scene;
  add_polygon(scene, "road", {{0, 0, 0}, {0, 0, 1}, {1e6, 0, 1}, {1e6, 0, 0}}, diffuse(0.5));
  const SurfaceModel surfaces = find_surfaces(scene);
  try {
    measuring_grids(scene, surfaces, "road", {.margin = std::nextafter(0.5, 0.0)});
    ADD_FAILURE() << "a grid";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("9.00719e+21 x 1 points"));
  }
}

// A frame of a metre is 0.05 m wide, and its points, 0.2 m apart from 0.1 on, are all in the hole.
TEST(MeasuringGrid, NoPointIsNoGrid) {
  constexpr std::array cuts{0.0, 0.05, 0.95, 1.0};
  Scene scene;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (i != 1 || k != 1)
        add_polygon(scene, "frame",
                    {{cuts[i], 0, cuts[k]},
                     {cuts[i], 0, cuts[k + 1]},
                     {cuts[i + 1], 0, cuts[k + 1]},
                     {cuts[i + 1], 0, cuts[k]}},
                    diffuse(0.5));
  const Scene frame = as_one_node(std::move(scene), "frame");
  EXPECT_THROW(measuring_grids(frame, find_surfaces(frame), "frame", {}), UsageError);
}

TEST(MeasuringGrid, Summary) {
  const std::vector<double> values{4.0, 1.0, 7.0};
  const GridSummary summary = summary_of(values);
  EXPECT_EQ(summary.minimum, 1.0);
  EXPECT_EQ(summary.mean, 4.0);
  EXPECT_EQ(summary.maximum, 7.0);
  EXPECT_EQ(summary.uniformity, 0.25);
  EXPECT_EQ(summary_of(std::vector<double>{0.0, 0.0}).uniformity, 0.0);
}

} // namespace
} // namespace meninas::test
