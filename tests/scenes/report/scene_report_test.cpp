// What is odd about scenes, each made odd in one way:
// it is found, counted and named, and what is meant is not.
#include "scenes/report/scene_report.h"
#include "scenes/surfaces/shells.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Oddity> report(const Scene& scene) {
  const SurfaceModel surfaces = find_surfaces(scene);
  return report_scene(scene, surfaces, make_ray_scene(scene, surfaces));
}

std::vector<Oddity> of_kind(const std::vector<Oddity>& all, const std::string& kind) {
  std::vector<Oddity> some;
  std::ranges::copy_if(all, std::back_inserter(some),
                       [&](const Oddity& one) { return one.kind == kind; });
  return some;
}

std::size_t count_of(const std::vector<Oddity>& all, const std::string& kind) {
  std::size_t count = 0;
  for (const Oddity& one : of_kind(all, kind)) {
    count += one.count;
  }
  return count;
}

void turn_round(Scene& scene) {
  for (Triangle& triangle : scene.triangles) {
    std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
}

/// A box of one node, with its corners shared.
Scene solid_box(const Material& material) {
  Scene scene;
  add_box(scene, "Box", {0, 0, 0}, {1, 2, 3}, material);
  for (Triangle& triangle : scene.triangles) {
    triangle.node = NodeId{0};
  }
  scene.nodes = {{"Box"}};
  return scene;
}

std::array<Material, 6> walls(const Material& material) {
  std::array<Material, 6> all;
  all.fill(material);
  return all;
}

TEST(SceneReport, WhatIsMeantIsNotOdd) {
  EXPECT_THAT(report(half_room()), IsEmpty()) << "a room of inward walls, a lamp and a box";
  EXPECT_THAT(report(doubled(half_room())), IsEmpty());
  EXPECT_THAT(report(solid_box(diffuse(0.5))), IsEmpty());
}

TEST(SceneReport, NamesWhatIsInsideOut) {
  Scene scene = solid_box(diffuse(0.5));
  turn_round(scene);
  const auto found = of_kind(report(scene), "inside_out");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "Box");
  EXPECT_EQ(found[0].count, 12u);
  EXPECT_THAT(found[0].text, HasSubstr("flip its normals"));

  Scene open = scene;
  open.triangles.resize(open.triangles.size() - 2);
  EXPECT_EQ(count_of(report(open), "inside_out"), 10u) << "a side may be missing";

  for (Material& material : scene.materials) {
    material.double_sided = true;
  }
  EXPECT_THAT(report(scene), IsEmpty()) << "two sides have no wrong one";
}

TEST(SceneReport, ARoomIsLookedIntoOrHoldsSomething) {
  Scene room;
  add_room(room, {0, 0, 0}, {4, 3, 5}, walls(diffuse(0.5)));
  EXPECT_EQ(count_of(report(room), "inside_out"), 12u) << "an empty one might be either";
  room.cameras.push_back(look_at({2, 1.5, 4}, {2, 1, 0}, 1.0));
  EXPECT_THAT(report(room), IsEmpty());
  room.cameras.clear();
  add_box(room, "Table", {1, 0.5, 1}, {2, 1, 2}, diffuse(0.5));
  EXPECT_THAT(report(room), IsEmpty());
}

TEST(SceneReport, NamesCamerasInSolids) {
  Scene scene = solid_box(diffuse(0.5));
  scene.cameras.push_back(look_at({0.5, 1, 2.5}, {0.5, 1, 0}, 1.0));
  scene.cameras.back().name = "View";
  const auto found = of_kind(report(scene), "camera_inside");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "View");
  EXPECT_EQ(found[0].other, "Box");
}

TEST(SceneReport, WindingNumbersAreThoseOfSolidsAndRooms) {
  Scene scene = solid_box(diffuse(0.5));
  const auto wind = [&](const Point3& x) {
    const auto shells = find_shells(scene, find_topology(scene, 1e-9));
    EXPECT_EQ(shells.size(), 1u);
    return winding_number(scene, shells.at(0), x);
  };
  // Sums of twelve arc tangents of doubles.
  EXPECT_NEAR(wind({0.25, 1.5, 1}), 1.0, 1e-12);
  EXPECT_NEAR(wind({2, 1, 1}), 0.0, 1e-12);
  turn_round(scene);
  EXPECT_NEAR(wind({0.25, 1.5, 1}), -1.0, 1e-12);
  EXPECT_NEAR(find_shells(scene, find_topology(scene, 1e-9)).at(0).volume, -6.0, 1e-12);
}

TEST(SceneReport, CountsEdgesBetweenFrontsAndBacks) {
  Scene scene = solid_box(diffuse(0.5));
  std::swap(scene.triangles[0].vertices[1], scene.triangles[0].vertices[2]);
  const auto found = of_kind(report(scene), "mixed_winding");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].count, 3u) << "all sides of the one that is turned";
}

TEST(SceneReport, CountsFacesThatAreThereTwice) {
  Scene scene;
  add_polygon(scene, "A", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, diffuse(0.5));
  add_polygon(scene, "B", {{1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, diffuse(0.2));
  auto found = of_kind(report(scene), "duplicate_faces");
  ASSERT_EQ(found.size(), 1u) << "whichever corner comes first";
  EXPECT_EQ(found[0].node, "B");
  EXPECT_EQ(found[0].other, "A");

  Scene sheet;
  add_polygon(sheet, "Front", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, diffuse(0.5));
  add_polygon(sheet, "Back", {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}}, diffuse(0.5));
  EXPECT_EQ(count_of(report(sheet), "duplicate_faces"), 0u) << "back to back they are a sheet";
  sheet.materials[index(sheet.triangles[1].material)].double_sided = true;
  EXPECT_EQ(count_of(report(sheet), "duplicate_faces"), 1u);
}

TEST(SceneReport, NamesFacesThatLieOnOneAnother) {
  Scene scene;
  add_polygon(scene, "Floor", {{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}}, diffuse(0.5));
  add_polygon(scene, "Rug", {{-1, 0, 1}, {1, 0, 1.5}, {1, 0, -1}, {-1, 0, -1}}, diffuse(0.2));
  // Beside one another, one above the other, and back to back: as it should be.
  add_polygon(scene, "Next", {{5, 0, 5}, {6, 0, 5}, {6, 0, -5}, {5, 0, -5}}, diffuse(0.2));
  add_polygon(scene, "Mat", {{2, 0.01, 4}, {4, 0.01, 4}, {4, 0.01, 2}, {2, 0.01, 2}}, diffuse(0.2));
  add_polygon(scene, "Below", {{-2, 0, 2}, {-2, 0, -2}, {2, 0, -2}, {2, 0, 2}}, diffuse(0.2));
  const auto found = of_kind(report(scene), "overlapping_faces");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "Floor");
  EXPECT_EQ(found[0].other, "Rug");
  EXPECT_EQ(found[0].count, 2u) << "both triangles of the floor";
}

TEST(SceneReport, CountsCrowdedEdgesAndTJunctions) {
  Scene fins;
  add_polygon(fins, "Fins", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, diffuse(0.5));
  for (const Point3& tip : {Point3(0, 0, 1), Point3(0, -1, 0)}) {
    add_polygon(fins, "Fins", {{0, 0, 0}, {1, 0, 0}, tip}, diffuse(0.5));
    fins.triangles.back().node = NodeId{0};
  }
  EXPECT_EQ(count_of(report(fins), "non_manifold"), 1u);

  Scene wall;
  add_polygon(wall, "Long", {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  add_polygon(wall, "Half", {{0, -1, 0}, {1, -1, 0}, {1, 0, 0}, {0, 0, 0}}, diffuse(0.5));
  const auto found = of_kind(report(wall), "t_junctions");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "Long") << "a corner of the other is in the middle of its edge";
}

TEST(SceneReport, CountsSliversButNotThinStrips) {
  Scene scene;
  add_polygon(scene, "Hair", {{0, 0, 0}, {2, 0, 0}, {2, 0.0019, 0}}, diffuse(0.5));
  add_polygon(scene, "Strip", {{0, 1, 0}, {2, 1, 0}, {2, 1.0021, 0}}, diffuse(0.5));
  const auto found = of_kind(report(scene), "slivers");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "Hair");
}

TEST(SceneReport, CountsCornersWhereOverAThousandFacesOfANodeMeet) {
  const auto cone = [](std::uint32_t faces) {
    Scene scene;
    const auto rim = [&](std::uint32_t k) {
      const double angle = 2.0 * std::numbers::pi * (k % faces) / faces;
      return Point3(std::cos(angle), 0.0, std::sin(angle));
    };
    for (std::uint32_t k = 0; k < faces; ++k) {
      add_polygon(scene, "Cone", {{0, 1, 0}, rim(k + 1), rim(k)}, diffuse(0.5));
      scene.triangles.back().node = NodeId{0};
    }
    return scene;
  };
  EXPECT_EQ(count_of(report(cone(1000)), "crowded_corners"), 0u);
  const auto found = of_kind(report(cone(1001)), "crowded_corners");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, "Cone");
  EXPECT_EQ(found[0].count, 1u) << "the tip, and no corner of the rim";
}

TEST(SceneReport, CountsWhatPassesThroughAndNotWhatTouches) {
  Scene scene;
  add_polygon(scene, "Floor", {{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}}, diffuse(0.5));
  add_box(scene, "Stands", {0, 0, 0}, {1, 1, 1}, diffuse(0.5));
  EXPECT_EQ(count_of(report(scene), "crossing"), 0u);
  add_box(scene, "Sinks", {3, -0.1, 0}, {4, 1, 1}, diffuse(0.5));
  const auto found = of_kind(report(scene), "crossing");
  ASSERT_EQ(found.size(), 4u) << "the four sides of the sunken box";
  EXPECT_EQ(found[0].node, "Floor");
  EXPECT_THAT(found[0].other, HasSubstr("Sinks"));
}

TEST(SceneReport, SuspectsUnits) {
  Scene scene = half_room();
  const auto kinds = [&](double scale, Vec3 offset, double error) {
    Scene moved = transformed(scene, glm::dmat3(1.0), scale, offset);
    moved.position_error = error;
    std::vector<std::string> names;
    for (const Oddity& one : report(moved)) {
      names.push_back(one.kind);
    }
    return names;
  };
  EXPECT_THAT(kinds(1000.0, Vec3(0.0), 1e-4), Contains("too_large"));
  EXPECT_THAT(report(transformed(scene, glm::dmat3(1.0), 1000.0, Vec3(0.0))).at(0).text,
              HasSubstr("millimetres, scale it by 0.001"));
  EXPECT_THAT(kinds(1e-3, Vec3(0.0), 1e-10), Contains("too_small"));
  EXPECT_THAT(kinds(1.0, Vec3(1e5, 0, 0), 0.004), Contains("far_away"));

  add_box(scene, "Chair", {0, 0, 0}, {9000, 9000, 9000}, diffuse(0.5));
  const auto unlike = of_kind(report(scene), "unlike_size");
  ASSERT_EQ(unlike.size(), 6u);
  EXPECT_THAT(unlike[0].node, HasSubstr("Chair"));
}

/// Loose triangles that all cross: every edge has all corners in its box.
TEST(SceneReport, EndsOnATangle) {
  Scene scene;
  for (int k = 0; k < 3000; ++k) {
    const double a = 0.7 * k;
    const Vec3 along(std::cos(a), std::sin(3.0 * a), std::sin(a));
    add_polygon(scene, "Tangle", {along, -along, {std::sin(5.0 * a), 1.0, std::cos(2.0 * a)}},
                diffuse(0.5));
    scene.triangles.back().node = NodeId{0};
  }
  EXPECT_GT(count_of(report(scene), "crossing"), 1000u);
}

} // namespace
} // namespace meninas::test
