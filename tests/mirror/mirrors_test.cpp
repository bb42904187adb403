#include "mirror/mirrors.h"
#include "tests/support/globes.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double rounding = 1e-12;

MirrorSet mirrors_of(const Scene& scene) { return find_mirrors(scene, find_surfaces(scene)); }

double window_area(const Mirror& mirror) {
  double sum = 0.0;
  for (const auto& part : mirror.window)
    sum += glm::dot(area_vector(part.span()), mirror.plane.normal);
  return sum;
}

/// In the plane z = 0, facing +z.
std::vector<Point3> tile(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0}};
}

TEST(FindMirrors, NoMirrorInADiffuseRoom) {
  Scene scene;
  add_room(scene, Point3(0.0), Point3(1.0),
           {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
  const MirrorSet set = mirrors_of(scene);
  EXPECT_TRUE(set.mirrors.empty());
  EXPECT_EQ(set.facets, 0U);
}

TEST(FindMirrors, CoplanarPiecesAreOneMirror) {
  Scene scene;
  add_polygon(scene, "left", tile(0, 0, 1, 1), mirror(0.8));
  add_polygon(scene, "right", tile(3, 0, 4, 2), mirror(0.8));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 1U);
  const Mirror& mirror = set.mirrors[0];
  EXPECT_NEAR(mirror.area, 3.0, rounding);
  EXPECT_NEAR(window_area(mirror), 3.0, rounding);
  EXPECT_LT(glm::distance(mirror.plane.normal, Direction(0, 0, 1)), rounding);
  EXPECT_EQ(mirror.nodes.size(), 2U);
  EXPECT_DOUBLE_EQ(mirror.reflectance.g, 0.8);
}

TEST(FindMirrors, RowsOfCornersThatAreStraightButForRoundingAreOneWindow) {
  // 12 x 30 quads of one plane, rounded to a tenth of a millimetre within it.
  Random random(5);
  std::vector<Point3> corner;
  for (int j = 0; j <= 30; ++j)
    for (int i = 0; i <= 12; ++i)
      corner.push_back(random.in_box({-5e-5, -5e-5, 0}, {5e-5, 5e-5, 0}) +
                       Vec3(0.05 * i, 0.05 * j, 0.0));
  Scene scene;
  const Material silver = mirror(0.8);
  for (std::size_t j = 0; j < 30; ++j)
    for (std::size_t i = 0; i < 12; ++i) {
      const std::size_t k = 13 * j + i;
      add_polygon(scene, "tile", {corner[k], corner[k + 1], corner[k + 14], corner[k + 13]},
                  silver);
    }
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 1U);
  EXPECT_LE(set.mirrors[0].window.size(), 16U);
  // The outline is off by at most 3e-4 of a metre along the circumference of 4.2 m.
  EXPECT_NEAR(window_area(set.mirrors[0]), 0.9, 3e-4 * 4.2);
}

TEST(FindMirrors, TwoReflectancesAreTwoMirrorsLargestFirst) {
  Scene scene;
  add_polygon(scene, "small", tile(0, 0, 1, 1), mirror(0.8));
  add_polygon(scene, "large", tile(1, 0, 4, 1), mirror(0.7));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 2U);
  EXPECT_NEAR(set.mirrors[0].area, 3.0, rounding);
  EXPECT_DOUBLE_EQ(set.mirrors[0].reflectance.r, 0.7);
}

TEST(FindMirrors, OneMirrorFacesOneWay) {
  Scene scene;
  auto back = tile(1, 0, 2, 1);
  std::reverse(back.begin(), back.end());
  add_polygon(scene, "front", tile(0, 0, 1, 1), mirror(0.8));
  add_polygon(scene, "back", back, mirror(0.8));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 2U);
  EXPECT_NEAR(glm::dot(set.mirrors[0].plane.normal, set.mirrors[1].plane.normal), -1.0, rounding);
}

TEST(FindMirrors, DoubleSidedIsTwoMirrorsBackToBack) {
  Scene scene;
  add_polygon(scene, "sheet", tile(0, 0, 2, 1), double_sided(mirror(0.8)));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 2U);
  ASSERT_EQ(set.mirror_of_surface.size(), 1U);
  const auto faces = set.mirror_of_surface[0];
  ASSERT_NE(faces[0], faces[1]);
  const Mirror& front = set.mirrors[index(faces[0])];
  const Mirror& back = set.mirrors[index(faces[1])];
  EXPECT_NEAR(front.plane.normal.z, 1.0, rounding);
  EXPECT_NEAR(back.plane.normal.z, -1.0, rounding);
  EXPECT_EQ(front.plane_class, back.plane_class);
  EXPECT_NEAR(window_area(front), 2.0, rounding);
  EXPECT_NEAR(window_area(back), 2.0, rounding);
}

TEST(FindMirrors, SingleSidedHasNoMirrorAtItsBack) {
  Scene scene;
  add_polygon(scene, "sheet", tile(0, 0, 2, 1), mirror(0.8));
  const MirrorSet set = mirrors_of(scene);
  EXPECT_EQ(set.mirror_of_surface[0][0], MirrorId{0});
  EXPECT_EQ(set.mirror_of_surface[0][1], none<MirrorId>);
}

TEST(FindMirrors, AThousandTilesAreOneMirror) {
  Scene scene;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 25; ++j)
      add_polygon(scene, "tile", tile(0.1 * i, 0.1 * j, 0.1 * (i + 1), 0.1 * (j + 1)), mirror(0.9));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 1U);
  EXPECT_EQ(set.facets, 0U);
  EXPECT_NEAR(set.mirrors[0].area, 10.0, 1e-9); // a thousand areas of 0.01 added up
  EXPECT_NEAR(window_area(set.mirrors[0]), 10.0,
              1e-9); // and none of it lost where pieces are merged
}

TEST(FindMirrors, AnLShapeKeepsItsArea) {
  Scene scene;
  add_polygon(scene, "a", tile(0, 0, 2, 1), mirror(0.9));
  add_polygon(scene, "b", tile(0, 1, 1, 3), mirror(0.9));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 1U);
  EXPECT_NEAR(window_area(set.mirrors[0]), 4.0, rounding);
}

/// A sphere of `rings` times twice as many facets, normals outward.
void add_sphere(Scene& scene, const Point3& centre, double radius, int rings,
                const Material& material) {
  const auto at = [&](int ring, int step) {
    const double t = std::numbers::pi * ring / rings, p = std::numbers::pi * step / rings;
    return centre +
           radius * Vec3(std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < 2 * rings; ++step) {
      std::vector<Point3> corners{at(ring, step), at(ring, step + 1), at(ring + 1, step + 1),
                                  at(ring + 1, step)};
      if (ring == 0)
        corners.erase(corners.begin());
      else if (ring + 1 == rings)
        corners.pop_back();
      add_polygon(scene, "ball", corners, material);
    }
}

TEST(FindMirrors, AFacetedSphereIsNotEnumerated) {
  Scene scene;
  add_sphere(scene, Point3(0.0), 1.0, 16, mirror(0.9));
  const MirrorSet set = mirrors_of(scene);
  EXPECT_TRUE(set.mirrors.empty());
  EXPECT_EQ(set.facets, set.mirror_of_surface.size());
  EXPECT_GE(set.facets, 400U);
}

// What reflects by normals that turn has no one image, however few its planes are; a flat mirror
// in the plane of one of its facets keeps its own.
TEST(FindMirrors, WhatIsCurvedIsFollowedByRaysAlone) {
  for (const GivenNormals normals : {GivenNormals::flat, GivenNormals::smooth}) {
    Scene scene;
    add_globe(scene, "ball", {.meridians = 4, .parallels = 3}, mirror(0.9), normals);
    const std::size_t of_ball = mirrors_of(scene).mirrors.size();
    EXPECT_EQ(of_ball > 0, normals == GivenNormals::flat);
    const auto p = corners(scene, TriangleId{0});
    const Vec3 aside = 3.0 * glm::normalize(p[1] - p[0]);
    add_polygon(scene, "wall", {p[0] + aside, p[1] + aside, p[2] + aside}, mirror(0.9));
    const MirrorSet set = mirrors_of(scene);
    if (normals == GivenNormals::smooth) {
      ASSERT_EQ(set.mirrors.size(), 1U);
      EXPECT_NEAR(set.mirrors[0].area, glm::length(area_vector(p)), 1e-9);
    }
  }
}

TEST(FindMirrors, APlaneMirrorBesideAFacetedSphereStays) {
  Scene scene;
  add_sphere(scene, {0.0, 0.0, 2.0}, 0.5, 12, mirror(0.9));
  add_polygon(scene, "wall", tile(-3, -3, 3, 3), mirror(0.9));
  const MirrorSet set = mirrors_of(scene);
  ASSERT_EQ(set.mirrors.size(), 1U);
  EXPECT_NEAR(set.mirrors[0].area, 36.0, 1e-9);
  EXPECT_GE(set.facets, 200U);
}

} // namespace
} // namespace meninas::test
