// What is flat but for rounding is made flat, and what is curved stays so.
#include "scenes/repair/nearly_flat.h"
#include "scenes/shading_normal.h"
#include "scenes/surfaces/surfaces.h"
#include "tests/scenes/soup.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace meninas::test {
namespace {

using Shape = std::function<Point3(double, double)>;

/// A mirror of 0.7 x 1.7 m that leans back by six degrees.
Point3 leaning(double u, double v) {
  const double lean = 6.0 * std::numbers::pi / 180.0;
  return {-0.6 + 0.7 * u, 0.02 + 1.7 * v * std::cos(lean), -1.8 - 1.7 * v * std::sin(lean)};
}
const Direction leaning_normal =
    glm::normalize(glm::cross(leaning(1, 0) - leaning(0, 0), leaning(0, 1) - leaning(0, 0)));

Scene grid(int columns, int rows, const Shape& shape) {
  Scene scene = empty_soup();
  add_grid(scene, columns, rows, shape);
  return scene;
}

Scene rounded_to(double step, Scene scene) {
  for (Vertex& vertex : scene.vertices)
    vertex.position = step * glm::round(vertex.position / step);
  return scene;
}

Scene with_noise(double most, Scene scene) {
  Random random(7);
  for (Vertex& vertex : scene.vertices)
    vertex.position += random.in_box(Vec3(-most), Vec3(most));
  return scene;
}

std::vector<float> half_steps(const Scene& scene, double step) {
  return std::vector<float>(scene.vertices.size(), static_cast<float>(0.5 * step));
}

std::size_t surfaces_of(const Scene& scene) { return find_surfaces(scene).surfaces.size(); }

/// A ball of 162 facets, in rings of nine.
Scene ball() {
  return grid(9, 9, [](double u, double v) {
    const double phi = -2.0 * std::numbers::pi * u, theta = std::numbers::pi * (0.01 + 0.98 * v);
    return Point3(std::sin(theta) * std::cos(phi), std::cos(theta),
                  std::sin(theta) * std::sin(phi));
  });
}

/// 64 segments of a cylinder of 0.2 m, each in 16 pieces.
Scene cylinder() {
  return grid(64, 16, [](double u, double v) {
    const double phi = -2.0 * std::numbers::pi * u;
    return Point3(0.2 * std::cos(phi), v, 0.2 * std::sin(phi));
  });
}

/// A shaving mirror of 0.2 m that is part of a sphere of 2 m: its sagitta is 2.5 mm.
Scene shaving_mirror(int columns) {
  return grid(columns, columns, [](double u, double v) {
    const double x = 0.2 * (u - 0.5), y = 0.2 * (v - 0.5);
    return Point3(x, y, (x * x + y * y) / 4.0);
  });
}

TEST(NearlyFlat, AMirrorOfFourteenBitsIsOneSurface) {
  for (const int columns : {1, 3, 12, 40}) {
    const double step = 1.7 / 16383.0;
    Scene scene = rounded_to(step, grid(columns, 2 * columns, leaning));
    EXPECT_GT(surfaces_of(scene), 1u) << columns;
    const Flattening made = flatten_nearly_flat(scene, half_steps(scene, step));
    EXPECT_EQ(surfaces_of(scene), 1u) << columns;
    // A plane through corners that are each off by at most the half of a diagonal of a step.
    EXPECT_LE(made.farthest, 0.5 * std::sqrt(3.0) * step * 2.0) << columns;
    const double turn =
        glm::length(glm::cross(find_surfaces(scene).surfaces[0].plane.normal, leaning_normal));
    EXPECT_LE(turn, std::sqrt(3.0) * step / 0.7) << columns;
  }
}

// Its normals are those of the plane; the facets turn by a thousandth and more until they are flat.
TEST(NearlyFlat, WhatIsMadeFlatIsCurvedNoMore) {
  constexpr double step = 2e-4;
  Scene scene = rounded_to(step, grid(20, 20, leaning));
  for (Vertex& vertex : scene.vertices)
    vertex.normal = glm::vec3(leaning_normal);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    mark_curved(scene, TriangleId{t});
  ASSERT_TRUE(std::ranges::any_of(scene.triangles, &Triangle::curved));
  flatten_nearly_flat(scene, half_steps(scene, step));
  EXPECT_TRUE(std::ranges::none_of(scene.triangles, &Triangle::curved));
}

TEST(NearlyFlat, NoiseThatNothingStatesIsTakenOutToo) {
  for (const double noise : {1e-6, 5e-6, 3e-5}) {
    Scene scene = with_noise(noise, grid(14, 30, leaning));
    EXPECT_GT(surfaces_of(scene), 10u) << noise;
    flatten_nearly_flat(scene);
    EXPECT_EQ(surfaces_of(scene), 1u) << noise;
  }
  // A tenth of a millimetre, as of coordinates with four decimals.
  Scene decimals = rounded_to(1e-4, grid(14, 30, leaning));
  flatten_nearly_flat(decimals);
  EXPECT_EQ(surfaces_of(decimals), 1u);
}

TEST(NearlyFlat, AQuadWithOneCornerOffIsFlatIfThatCannotBeSeen) {
  const auto with_corner_off = [](double off) {
    Scene scene = empty_soup();
    add_quad(scene, {Point3(0, 0, 0), {1, 0, 0}, {1, 1, off}, {0, 1, 0}});
    flatten_nearly_flat(scene);
    return surfaces_of(scene);
  };
  // The plane of least squares is a quarter of it off, and turned by half of it.
  EXPECT_EQ(with_corner_off(1e-4), 1u);
  EXPECT_EQ(with_corner_off(2e-3), 2u);
}

TEST(NearlyFlat, WhatIsCurvedStaysAsItIs) {
  for (Scene scene : {ball(), cylinder(), shaving_mirror(8), shaving_mirror(40)}) {
    const auto before = scene.vertices;
    EXPECT_EQ(flatten_nearly_flat(scene).surfaces, 0u);
    for (std::size_t v = 0; v < before.size(); ++v)
      EXPECT_EQ(scene.vertices[v].position, before[v].position);
  }
}

TEST(NearlyFlat, WhatIsCurvedAndRoundedStaysCurved) {
  // Normals of what is made flat follow those of the exact shape: they turn by 64 steps around a
  // cylinder and by 0.1 across the mirror, and must do so still.
  const auto largest_turn = [](const Scene& exact, const Scene& made) {
    double turn = 0.0;
    for (std::uint32_t t = 0; t < made.triangles.size(); ++t) {
      const Vec3 a = glm::normalize(area_vector(corners(exact, TriangleId{t}))),
                 b = glm::normalize(area_vector(corners(made, TriangleId{t})));
      turn = std::max(turn, glm::length(glm::cross(a, b)));
    }
    return turn;
  };
  for (const auto& [exact, size] :
       {std::pair(ball(), 2.0), std::pair(cylinder(), 1.0), std::pair(shaving_mirror(40), 0.2)}) {
    const double step = size / 16383.0;
    Scene made = rounded_to(step, exact);
    const double rounded = largest_turn(exact, made);
    flatten_nearly_flat(made, half_steps(made, step));
    EXPECT_LE(largest_turn(exact, made), 1.5 * rounded + 1e-3) << size;
  }
}

TEST(NearlyFlat, RipplesAreNoNoise) {
  Scene scene = grid(100, 4, [](double u, double v) {
    return Point3(u, v, 2e-4 * std::sin(20.0 * std::numbers::pi * u));
  });
  EXPECT_EQ(flatten_nearly_flat(scene).surfaces, 0u);
}

TEST(NearlyFlat, WallsOfARoundedRoomMeetInTheirEdges) {
  // Six walls of eight by eight quads in an oblique room, whose corners three walls share.
  Scene box;
  add_room(box, Point3(0.0), {4.0, 2.5, 6.0}, {});
  box = transformed(box, oblique_rotation(), 1.0, {0.3, 0.2, 0.1});
  Scene scene = empty_soup();
  for (std::size_t wall = 0; wall < 6; ++wall) {
    const auto p = [&](std::size_t k) { return box.vertices[4 * wall + k].position; };
    add_grid(scene, 8, 8,
             [&](double u, double v) { return p(0) + u * (p(1) - p(0)) + v * (p(3) - p(0)); });
  }
  const double step = 7.0 / 65535.0;
  scene = rounded_to(step, scene);
  EXPECT_GT(surfaces_of(scene), 6u);
  const Flattening made = flatten_nearly_flat(scene, half_steps(scene, step));
  EXPECT_EQ(made.surfaces, 6u);
  const SurfaceModel model = find_surfaces(scene);
  EXPECT_EQ(model.surfaces.size(), 6u);
  // Vertices of two walls are in both planes to the rounding of doubles: no cracks.
  for (const Vertex& vertex : scene.vertices) {
    int planes = 0;
    for (const Surface& surface : model.surfaces)
      planes += std::abs(signed_distance(surface.plane, vertex.position)) < 1e-9 ? 1 : 0;
    const int walls =
        static_cast<int>(std::ranges::count_if(model.surfaces, [&](const Surface& surface) {
          return std::abs(signed_distance(surface.plane, vertex.position)) < 10.0 * step;
        }));
    EXPECT_EQ(planes, walls);
  }
}

TEST(NearlyFlat, WhatIsFlatKeepsItsBits) {
  Scene room;
  add_room(room, Point3(0.0), {4.0, 2.5, 6.0}, {});
  for (Scene scene : {room, rounded_to_float(transformed(grid(30, 30, leaning), oblique_rotation(),
                                                         1.0, Vec3(3.0, 2.0, 1.0)))}) {
    const auto before = scene.vertices;
    EXPECT_EQ(flatten_nearly_flat(scene).vertices, 0u);
    for (std::size_t v = 0; v < before.size(); ++v)
      EXPECT_EQ(scene.vertices[v].position, before[v].position);
  }
}

TEST(NearlyFlat, ScaleDoesNotMatter) {
  for (const double scale : {1e-4, 1e6}) {
    Scene scene =
        transformed(with_noise(5e-6, grid(14, 30, leaning)), oblique_rotation(), scale, Vec3(0.0));
    flatten_nearly_flat(scene);
    EXPECT_EQ(surfaces_of(scene), 1u) << scale;
  }
}

} // namespace
} // namespace meninas::test
