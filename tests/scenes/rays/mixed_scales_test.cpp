// Small things in scenes that reach far: what is beyond says nothing of how well they are known.
#include "scenes/rays/mixed_scales.h"
#include "tests/scenes/soup.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double gap = 1e-3;

/// As an exporter writes them: each position rounded to floats.
Scene as_exported(Scene scene) {
  scene.position_error = 0.0;
  for (Vertex& vertex : scene.vertices) {
    vertex.position = Point3(glm::vec3(vertex.position));
    const double error = std::ldexp(glm::length(vertex.position), -24);
    scene.position_errors.push_back(static_cast<float>(error));
    scene.position_error = std::max(scene.position_error, error);
  }
  return scene;
}

/// Two unit squares that face each other across the gap, and a triangle somewhere else.
Scene squares_and_far_triangle(double distance) {
  Scene scene;
  const Material grey = diffuse(0.5);
  add_polygon(scene, "a", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, grey);
  add_polygon(scene, "b", {{0, 1, gap}, {1, 1, gap}, {1, 0, gap}, {0, 0, gap}}, grey);
  if (distance > 0.0)
    add_polygon(scene, "far",
                {{distance, 0, 0}, {distance, 0.2 * distance, 0}, {distance, 0, 0.1 * distance}},
                grey);
  return scene;
}

constexpr std::array distances{3e3, 1e4, 1e6};

TEST(MixedScales, PlanesOfTheDetailStayApart) {
  for (const glm::dmat3& rotation : {glm::dmat3(1.0), oblique_rotation()})
    for (const double distance : distances) {
      const Scene scene =
          as_exported(transformed(squares_and_far_triangle(distance), rotation, 1.0, Vec3(0.0)));
      const SurfaceModel model = find_surfaces(scene);
      EXPECT_EQ(model.planes.size(), 3U) << distance;
      EXPECT_LT(model.tolerance, 1e-2 * gap) << distance;
    }
}

// Coplanar walls in pieces, of nodes of their own, so that vertices are rounded apart:
// beyond the detail they merge to their own rounding, in it to that of the detail.
TEST(MixedScales, WallsMergeWhereverTheyAre) {
  for (const double distance : distances)
    for (const double place : {0.0, distance}) {
      Scene scene;
      const double size = std::max(1.0, 0.1 * place);
      for (int k = 0; k < 6; ++k)
        add_polygon(scene, "piece" + std::to_string(k),
                    {{place + k * size, 0, 0},
                     {place + (k + 1) * size, 0, 0},
                     {place + (k + 1) * size, size, 0},
                     {place + k * size, size, 0}},
                    diffuse(0.5));
      if (place > 0.0)
        add_room(scene, Point3(0.0), Point3(1.0), {});
      if (place > 0.0)
        add_box(scene, "box", Point3(0.2), Point3(0.4), diffuse(0.5));
      else
        add_polygon(scene, "far",
                    {{distance, 0, 1}, {distance, distance, 1}, {distance, 0, distance}},
                    diffuse(0.5));
      const Scene turned = as_exported(transformed(scene, oblique_rotation(), 1.0, Vec3(0.0)));
      const SurfaceModel model = find_surfaces(turned);
      for (std::size_t t = 1; t < 12; ++t)
        EXPECT_EQ(model.plane_of_triangle[t], model.plane_of_triangle[0]) << distance << place;
    }
}

// Rays from the one square to the other, but for those that meet it within 1e-4 of its edge:
// a float of the frame is there one of the detail, 1e-7, at the most slanted ray times ten.
TEST(MixedScales, RaysAcrossAGap) {
  for (const glm::dmat3& rotation : {glm::dmat3(1.0), oblique_rotation()})
    for (const double distance : distances) {
      const Scene scene =
          as_exported(transformed(squares_and_far_triangle(distance), rotation, 1.0, Vec3(0.0)));
      const SurfaceModel surfaces = find_surfaces(scene);
      const RayScene rays = make_ray_scene(scene, surfaces);
      Random random(1);
      for (int k = 0; k < 1000; ++k) {
        const Point3 x = random.in_box({0, 0, 0}, {1, 1, 0});
        Direction d = random.direction();
        d.z = std::abs(d.z);
        const Point3 end = x + gap / d.z * d;
        const double inside = std::min({end.x, end.y, 1.0 - end.x, 1.0 - end.y});
        if (d.z < 0.1 || std::abs(inside) < 1e-4)
          continue;
        const auto hit =
            closest_hit(rays, {rotation * x, rotation * d, surfaces.plane_of_triangle[0]});
        EXPECT_EQ(hit && index(scene.triangles[index(hit->triangle)].node) == 1 && hit->front,
                  inside > 0.0)
            << distance;
        const Leg leg{rotation * x, rotation * end, surfaces.plane_of_triangle[0],
                      surfaces.plane_of_triangle[2]};
        EXPECT_FALSE(occluded(rays, leg));
        EXPECT_EQ(hit.has_value() && std::abs(hit->distance - gap / d.z) < 1e-6, inside > 0.0);
      }
    }
}

// A closed room on a ground: every ray from a wall meets a wall, from its front.
TEST(MixedScales, RoomOnAWideGround) {
  for (const double width : {1e3, 1e5, 1e6}) {
    Scene scene = furnace(0.8, {});
    const double half = 0.5 * width;
    add_polygon(
        scene, "ground",
        {{-half, -0.01, half}, {half, -0.01, half}, {half, -0.01, -half}, {-half, -0.01, -half}},
        diffuse(0.5));
    scene = as_exported(std::move(scene));
    const SurfaceModel surfaces = find_surfaces(scene);
    const RayScene rays = make_ray_scene(scene, surfaces);
    Random random(2);
    for (std::uint32_t t = 0; t < 12; ++t)
      for (int k = 0; k < 500; ++k) {
        const auto p = corners(scene, TriangleId{t});
        const Direction normal = glm::normalize(area_vector(p));
        const double u = random.between(0.0, 1.0), v = random.between(0.0, 1.0 - u);
        Direction d = random.direction();
        d = glm::dot(d, normal) < 0.0 ? -d : d;
        const auto hit = closest_hit(
            rays, {p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]), d, surfaces.plane_of_triangle[t]});
        ASSERT_TRUE(hit.has_value()) << width;
        EXPECT_LT(index(hit->triangle), 12U) << width;
        EXPECT_TRUE(hit->front) << width;
      }
    EXPECT_THAT(warnings_of_mixed_scales(scene, surfaces, rays), IsEmpty()) << width;
  }
}

std::vector<std::string> warnings_of(const Scene& scene) {
  const SurfaceModel surfaces = find_surfaces(scene);
  return warnings_of_mixed_scales(scene, surfaces, make_ray_scene(scene, surfaces));
}

/// A rough land of 2 x 50 x 50 triangles, of which the detail is part.
Scene land(double width) {
  Scene scene = empty_soup(1, 1);
  scene.nodes[0].name = "land";
  Random random(3);
  add_grid(scene, 50, 50, [&](double u, double v) {
    return Point3((u - 0.503) * width, -0.01 * width * random.between(1.0, 2.0),
                  (0.503 - v) * width);
  });
  return scene;
}

TEST(MixedScales, WhatRaysCannotTellIsSaid) {
  EXPECT_THAT(warnings_of(as_exported(squares_and_far_triangle(0.0))), IsEmpty());
  EXPECT_THAT(warnings_of(as_exported(squares_and_far_triangle(3e3))), IsEmpty());
  EXPECT_THAT(warnings_of(as_exported(half_room())), IsEmpty());

  // In a land of very many corners the two squares are no detail.
  for (const double width : {1e3, 3e3, 1e5}) {
    Scene scene = land(width);
    const Scene squares = squares_and_far_triangle(0.0);
    for (const auto* name : {"a", "b"}) {
      const std::size_t first = name == std::string("a") ? 0 : 4;
      std::vector<Point3> corners;
      for (std::size_t k = 0; k < 4; ++k)
        corners.push_back(squares.vertices[first + k].position);
      add_polygon(scene, name, corners, diffuse(0.5));
    }
    EXPECT_THAT(warnings_of(as_exported(scene)),
                ElementsAre(HasSubstr(width < 3e3 ? "touching" : "one plane")))
        << width;
  }

  // A closed plate a millimetre thick has nothing but itself behind its faces.
  Scene hall = land(1e3);
  add_box(hall, "plate", {0.0, 1.0, 0.0}, {0.5, 1.001, 0.5}, diffuse(0.5));
  EXPECT_THAT(warnings_of(as_exported(hall)), IsEmpty());

  // A level ground stays where it is in floats, a slanted one does not.
  Scene ground = furnace(0.8, {});
  add_polygon(ground, "ground",
              {{-1e6, -0.1, 1e6}, {1e6, -0.1, 1e6}, {1e6, -0.1, -1e6}, {-1e6, -0.1, -1e6}},
              diffuse(0.5));
  EXPECT_THAT(warnings_of(as_exported(ground)), IsEmpty());
  EXPECT_THAT(warnings_of(transformed(ground, oblique_rotation(), 1.0, Vec3(0.0))),
              ElementsAre(HasSubstr("'ground' passes the detail")));
}

} // namespace
} // namespace meninas::test
