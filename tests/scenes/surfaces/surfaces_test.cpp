#include "scenes/surfaces/surfaces.h"
#include "tests/scenes/soup.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace meninas::test {
namespace {

/// A room whose six walls share their material, each of columns x columns quads.
Scene tessellated_room(int columns) {
  Scene box;
  add_room(box, Point3(0.0), {4.0, 2.5, 6.0}, {});
  Scene scene = empty_soup();
  for (std::size_t wall = 0; wall < 6; ++wall) {
    const auto p = [&](std::size_t k) { return box.vertices[4 * wall + k].position; };
    add_grid(scene, columns, columns,
             [&](double u, double v) { return p(0) + u * (p(1) - p(0)) + v * (p(3) - p(0)); });
  }
  return scene;
}

Scene sphere(int columns, int rows) {
  Scene scene = empty_soup();
  add_grid(scene, columns, rows, [](double u, double v) {
    const double phi = -2.0 * std::numbers::pi * u;
    // Without the poles, where the quads of the grid would have no area.
    const double theta = std::numbers::pi * (0.05 + 0.9 * v);
    return Point3(std::sin(theta) * std::cos(phi), std::cos(theta),
                  std::sin(theta) * std::sin(phi));
  });
  return scene;
}

SurfaceModel checked_surfaces(const Scene& scene) {
  SurfaceModel model = find_surfaces(scene);
  expect_consistent(scene, model);
  return model;
}

TEST(Surfaces, NothingInNothingOut) {
  const SurfaceModel model = find_surfaces({});
  EXPECT_TRUE(model.surfaces.empty());
  EXPECT_TRUE(model.patches.empty());
  EXPECT_TRUE(model.planes.empty());
}

TEST(Surfaces, RoomHasSixWalls) {
  Scene scene;
  add_room(scene, {0.0, 0.0, 0.0}, {4.0, 2.5, 6.0}, {});
  const SurfaceModel model = checked_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), 6u);
  ASSERT_EQ(model.patches.size(), 6u);
  EXPECT_EQ(model.planes.size(), 6u);
  const std::array<Plane, 6> walls{{{{1, 0, 0}, 0.0},
                                    {{-1, 0, 0}, -4.0},
                                    {{0, 1, 0}, 0.0},
                                    {{0, -1, 0}, -2.5},
                                    {{0, 0, 1}, 0.0},
                                    {{0, 0, -1}, -6.0}}};
  const std::array<double, 6> areas{15.0, 15.0, 24.0, 24.0, 10.0, 10.0};
  for (std::size_t s = 0; s < 6; ++s) {
    // Numbers of few digits leave nothing to round.
    EXPECT_EQ(model.surfaces[s].plane.normal, walls[s].normal);
    EXPECT_EQ(model.surfaces[s].plane.offset, walls[s].offset);
    EXPECT_EQ(model.surfaces[s].area, areas[s]);
    EXPECT_EQ(model.patches[s].corner_count, 4);
    EXPECT_TRUE(model.patches[s].affine);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(model.patches[s].corners[k], scene.vertices[4 * s + k].position);
    }
  }
}

TEST(Surfaces, ALShapedWallOfTwoRectanglesIsOneSurface) {
  Scene scene = empty_soup();
  // The rectangles share the edge from (2, 1) to (3, 1), so the longer one is cut there.
  add_quad(scene, {Point3(0, 0, 0), {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  add_quad(scene, {Point3(2, 0, 0), {3, 0, 0}, {3, 1, 0}, {2, 1, 0}});
  add_quad(scene, {Point3(2, 1, 0), {3, 1, 0}, {3, 4, 0}, {2, 4, 0}});
  const SurfaceModel model = checked_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.surfaces[0].area, 6.0);
  EXPECT_EQ(model.patches.size(), 3u);
}

TEST(Surfaces, AWallWithAHoleIsOneSurface) {
  Scene scene = empty_soup();
  const std::array<Point3, 4> out{Point3(0, 0, 1), {6, 0, 1}, {6, 4, 1}, {0, 4, 1}};
  const std::array<Point3, 4> in{Point3(2, 1, 1), {4, 1, 1}, {4, 3, 1}, {2, 3, 1}};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    add_quad(scene, {out[k], out[next], in[next], in[k]});
  }
  const SurfaceModel model = checked_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), 1u);
  EXPECT_DOUBLE_EQ(model.surfaces[0].area, 20.0);
  ASSERT_EQ(model.patches.size(), 4u);
  for (const Patch& patch : model.patches) {
    EXPECT_EQ(patch.corner_count, 4);
    EXPECT_FALSE(patch.affine);
  }
}

TEST(Surfaces, MaterialsDivideAWallButNotItsPlane) {
  Scene scene = empty_soup(2);
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      const double x = i, y = j;
      add_quad(scene, {Point3(x, y, 0), {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}},
               MaterialId((i + j) % 2));
    }
  }
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 64u);
  EXPECT_EQ(model.patches.size(), 64u);
  EXPECT_EQ(model.planes.size(), 1u);
}

TEST(Surfaces, EveryFacetOfASphereIsItsOwn) {
  const Scene scene = sphere(48, 24);
  const SurfaceModel model = checked_surfaces(scene);
  // The two triangles between two circles of latitude form a plane trapezoid.
  EXPECT_EQ(model.surfaces.size(), 48u * 24u);
  EXPECT_EQ(model.patches.size(), 48u * 24u);
  EXPECT_EQ(model.planes.size(), 48u * 24u);
}

TEST(Surfaces, ASheetOfTwoFacesHasTwoSurfacesInOnePlane) {
  Scene scene = empty_soup();
  const std::array<Point3, 4> front{Point3(0, 0, 0.3), {2, 0, 0.3}, {2, 1, 0.3}, {0, 1, 0.3}};
  add_quad(scene, front);
  add_quad(scene, {front[3], front[2], front[1], front[0]});
  const SurfaceModel model = checked_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), 2u);
  EXPECT_EQ(model.patches.size(), 2u);
  EXPECT_EQ(model.planes.size(), 1u);
  EXPECT_EQ(model.surfaces[0].plane.normal, -model.surfaces[1].plane.normal);
}

/// 1000 unconnected tiles of one plane, every other one facing backwards.
Scene tiles() {
  Scene scene = empty_soup();
  for (int j = 0; j < 25; ++j) {
    for (int i = 0; i < 40; ++i) {
      const Point3 a(0.1 * i, 0.7, 0.1 * j);
      const Vec3 u(0.09, 0.0, 0.0), v(0.0, 0.0, 0.09);
      if ((i + j) % 2 == 0) {
        add_quad(scene, {a, a + u, a + u + v, a + v});
      } else {
        add_quad(scene, {a, a + v, a + u + v, a + u});
      }
    }
  }
  return scene;
}

TEST(Surfaces, UnconnectedTilesShareTheirPlane) {
  const SurfaceModel model = checked_surfaces(tiles());
  EXPECT_EQ(model.surfaces.size(), 1000u);
  EXPECT_EQ(model.planes.size(), 1u);
}

TEST(Surfaces, RoundedTilesStillShareTheirPlane) {
  const Scene scene =
      rounded_to_float(transformed(tiles(), oblique_rotation(), 1.0, {3.0, -2.0, 5.0}));
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 1000u);
  EXPECT_EQ(model.planes.size(), 1u);
}

TEST(Surfaces, NearPlanesAreApart) {
  Scene scene = empty_soup();
  for (int k = 0; k < 100; ++k) {
    // Ten times the tolerance of a scene of this extent apart.
    const double z = 3e-8 * k;
    add_quad(scene, {Point3(0, 0, z), {2, 0, z}, {2, 2, z}, {0, 2, z}});
  }
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 100u);
  EXPECT_EQ(model.planes.size(), 100u);
}

TEST(Surfaces, PlanesAlongTheOrderingDirectionAreFoundWhicheverWayTheyFace) {
  // Planes through the direction that tells orientations apart, each as three unconnected tiles
  // that face different ways: rounding alone decides how each of them is filed.
  const Vec3 v = glm::normalize(Vec3(0.5309, 0.6713, 0.5171));
  const Vec3 across = glm::normalize(glm::cross(v, Vec3(0.0, 0.0, 1.0)));
  Scene scene = empty_soup();
  const int count = 360;
  for (int k = 0; k < count; ++k) {
    const double angle = std::numbers::pi * (k + 0.37) / count;
    const Vec3 u = std::cos(angle) * across + std::sin(angle) * glm::cross(v, across);
    add_quad(scene, {u, 2.0 * u, 2.0 * u + v, u + v});
    add_quad(scene, {-u, -u + v, -2.0 * u + v, -2.0 * u});
    add_quad(scene, {2.1 * u, 2.1 * u + v, 3.0 * u + v, 3.0 * u});
  }
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 3u * count);
  EXPECT_EQ(model.planes.size(), std::size_t(count));
}

TEST(Surfaces, SplitVerticesConnect) {
  Scene scene = empty_soup();
  for (int i = 0; i < 10; ++i) {
    const double x = i;
    add_triangle(scene, {Point3(x, 0, 0), {x + 1, 0, 0}, {x + 1, 1, 0}});
    add_triangle(scene, {Point3(x, 0, 0), {x + 1, 1, 0}, {x, 1, 0}});
  }
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.patches.size(), 10u);
}

TEST(Surfaces, ThreeWallsAtOneEdgeConnectTheTwoThatAreCoplanar) {
  Scene scene = empty_soup();
  add_quad(scene, {Point3(-1, 0, 0), {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}});
  add_quad(scene, {Point3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  add_quad(scene, {Point3(0, 0, 0), {0, 0, 1}, {0, 1, 1}, {0, 1, 0}});
  add_quad(scene, {Point3(0, 0, -1), {0, 0, 0}, {0, 1, 0}, {0, 1, -1}});
  const SurfaceModel model = checked_surfaces(scene);
  ASSERT_EQ(model.surfaces.size(), 2u);
  EXPECT_EQ(model.surfaces[0].area, 2.0);
  EXPECT_EQ(model.surfaces[1].area, 2.0);
  EXPECT_EQ(model.patches.size(), 4u);
}

TEST(Surfaces, DuplicatedTrianglesNeitherPairNorHang) {
  Scene scene = empty_soup();
  for (int k = 0; k < 100000; ++k) {
    add_triangle(scene, {Point3(0, 0, 0), {1, 0, 0}, {0, 1, 0}});
  }
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.patches.size(), 100000u);
}

TEST(Surfaces, SliversJoinTheirWall) {
  // Strips of aspect 1e6 beside a wide wall, all in an oblique plane.
  Scene scene = empty_soup();
  add_quad(scene, {Point3(0, 0, 0), {10, 0, 0}, {10, 8, 0}, {0, 8, 0}});
  for (int k = 0; k < 50; ++k) {
    const double y = 8.0 + 1e-5 * k;
    add_quad(scene, {Point3(0, y, 0), {10, y, 0}, {10, y + 1e-5, 0}, {0, y + 1e-5, 0}});
  }
  const SurfaceModel model =
      checked_surfaces(transformed(scene, oblique_rotation(), 1.0, {1.0, 2.0, 3.0}));
  EXPECT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.patches.size(), 51u);
}

TEST(Surfaces, ACylinderDoesNotBendIntoOneSurface) {
  Scene scene = empty_soup();
  const int facets = 6000;
  const double step = 1e-5;
  add_grid(scene, facets, 1, [&](double u, double v) {
    const double phi = -step * facets * u;
    return Point3(std::cos(phi), v, std::sin(phi));
  });
  const SurfaceModel model = checked_surfaces(scene);
  // An arc of n facets rises by (n step)^2 / 8 over its chord, at most the tolerance on both sides.
  const double most = std::sqrt(16.0 * model.tolerance) / step;
  EXPECT_GE(double(model.surfaces.size()), facets / most);
}

TEST(Surfaces, RoughWallsKeepTheTolerance) {
  // Waves from below to far above the tolerance: surfaces grow in some places and end in others.
  for (const double wave : {0.5, 1.0, 1.5, 2.0, 4.0, 16.0}) {
    Scene scene = empty_soup();
    scene.position_error = 1e-5;
    add_grid(scene, 60, 60, [&](double u, double v) {
      const double tolerance = 4.0 * scene.position_error;
      return Point3(u, v, wave * tolerance * std::sin(9.0 * u + 4.0 * v) * std::cos(5.0 * u * v));
    });
    const SurfaceModel model = checked_surfaces(scene);
    EXPECT_EQ(model.surfaces.size() == 1, wave < 1.0) << wave;
  }
}

TEST(Surfaces, AQuadWhoseCornersAreAllOffIsOneSurface) {
  // The worst that the position error allows: corners alternately above and below their plane.
  const double e = 1e-5;
  Scene scene = empty_soup();
  add_quad(scene, {Point3(0, 0, e), {1, 0, -e}, {1, 1, e}, {0, 1, -e}});
  scene.position_error = e;
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.patches.size(), 1u);
}

TEST(Surfaces, VerticesThatNoTriangleUsesDoNotMatter) {
  Scene scene = tessellated_room(2);
  const std::size_t patches = checked_surfaces(scene).patches.size();
  for (const double far : {1e12, 1e30, -1e300}) {
    add_vertex(scene, Point3(far));
  }
  EXPECT_EQ(checked_surfaces(scene).patches.size(), patches);
}

TEST(Surfaces, HopelessNumbersNeitherHangNorCrash) {
  // Areas overflow, vanish or are not numbers;
  // such triangles have no plane, but everything has a patch.
  const double huge = 1e200, nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene = empty_soup();
  add_quad(scene, {Point3(0.0), {huge, 0, 0}, {huge, huge, 0}, {0, huge, 0}});
  add_quad(scene, {Point3(0.0), {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  add_triangle(scene, {Point3(1.0), Point3(1.0), Point3(1.0)});
  const SurfaceModel model = find_surfaces(scene);
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    EXPECT_LT(index(model.patch_of_triangle[t]), model.patches.size());
    EXPECT_LT(index(model.plane_of_triangle[t]), model.planes.size());
  }
}

struct Placement {
  double scale;
  Vec3 offset;
};

class PlacedRoom : public testing::TestWithParam<Placement> {};

TEST_P(PlacedRoom, HasSixWallsInDoubleAndInFloat) {
  for (const int columns : {1, 2, 7, 40}) {
    const Scene placed = transformed(tessellated_room(columns), oblique_rotation(),
                                     GetParam().scale, GetParam().offset);
    for (const Scene& scene : {placed, rounded_to_float(placed)}) {
      const SurfaceModel model = checked_surfaces(scene);
      EXPECT_EQ(model.surfaces.size(), 6u) << columns;
      EXPECT_EQ(model.planes.size(), 6u) << columns;
      EXPECT_EQ(model.patches.size(), std::size_t(6 * columns * columns)) << columns;
    }
  }
}

// Offsets of up to 1e4 room sizes leave floats some ten steps per tile of the finest tessellation.
INSTANTIATE_TEST_SUITE_P(Placements, PlacedRoom,
                         testing::Values(Placement{1.0, Vec3(0.0)}, Placement{1e-6, Vec3(0.0)},
                                         Placement{1e6, Vec3(0.0)},
                                         Placement{1.0, Vec3(100.0, -50.0, 70.0)},
                                         Placement{1e-3, Vec3(3.0, 1.0, -2.0)}));

TEST(Surfaces, FarFromTheOriginInDoublesNothingChanges) {
  const Scene scene = transformed(tessellated_room(7), oblique_rotation(), 1.0, {1e6, -2e6, 5e5});
  const SurfaceModel model = checked_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 6u);
  EXPECT_EQ(model.patches.size(), 6u * 49u);
}

/// Patches as sets of vertices, which do not depend on any order.
std::multiset<std::multiset<VertexId>> patch_sets(const SurfaceModel& model) {
  std::multiset<std::multiset<VertexId>> sets;
  for (const Patch& patch : model.patches) {
    sets.insert({patch.vertices.begin(), patch.vertices.begin() + patch.corner_count});
  }
  return sets;
}

TEST(Surfaces, TheOrderOfTrianglesDoesNotMatter) {
  Scene equilateral = empty_soup();
  add_grid(equilateral, 12, 9, [](double u, double v) {
    return Point3(12.0 * u - 4.5 * v, std::sqrt(0.75) * 9.0 * v, 0.0);
  });
  for (Scene scene :
       {equilateral, sphere(20, 10), tessellated_room(5), rounded_to_float(sphere(60, 40))}) {
    const SurfaceModel model = find_surfaces(scene);
    // A stride that is prime to the count visits every triangle once.
    std::vector<Triangle> shuffled;
    const std::size_t count = scene.triangles.size();
    for (std::size_t k = 0; k < count; ++k) {
      shuffled.push_back(scene.triangles[k * 7919 % count]);
    }
    scene.triangles = shuffled;
    const SurfaceModel other = find_surfaces(scene);
    EXPECT_EQ(patch_sets(model), patch_sets(other));
    EXPECT_EQ(model.surfaces.size(), other.surfaces.size());
    EXPECT_EQ(model.planes.size(), other.planes.size());
  }
}

} // namespace
} // namespace meninas::test
