// Pixels that are sure of their path show what their rays would have met.
#include "raytrace/pixels/sample_choice.h"
#include "raytrace/tiles.h"
#include "scenes/rays/frame_geometry.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

constexpr double rounding =
    2e-4; // of (u, v) in single precision, by the steepest change of the field across an element

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.target_elements = 300;
  settings.form_factors.rays = settings.interpolation.rays = 32;
  return settings;
}

struct BothWays {
  Image sure, traced;
  RayTotals sure_rays, traced_rays;
};

/// The picture by tiles, where paths are looked for, and pixel by pixel, where all rays are traced.
BothWays both_ways(const Scene& scene, const Camera& camera, int size) {
  const Taken taken = lit_up(scene, coarse());
  const LightScene& light = *taken.solution.field.scene;
  const VisibleLight visible = visible_light(taken.solution.field, FieldContent::all);
  RenderSettings settings;
  settings.width = settings.height = size;
  BothWays both{Image(size, size), Image(size, size), {}, {}};
  both.sure_rays =
      trace_picture({light, visible, nullptr, camera, settings}, {first_samples(settings)}, {},
                    [&](int x, int y, const SeenRadiance& seen) {
                      both.sure.at(x, y) = seen[0] + 2.0F * seen[1] + 3.0F * seen[2];
                    });
  std::vector<glm::ivec2> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      pixels.emplace_back(x, y);
  both.traced_rays = trace_pixels({light, visible, nullptr, camera, settings}, pixels,
                                  [&](int k, int, const SeenRadiance& seen) {
                                    both.traced.pixels[static_cast<std::size_t>(k)] =
                                        seen[0] + 2.0F * seen[1] + 3.0F * seen[2];
                                  });
  return both;
}

/// Expects the same picture and the same paths, at least so many of their rays for certain.
void expect_same(const Scene& scene, const Camera& camera, double min_sure, int size = 64) {
  const BothWays both = both_ways(scene, camera, size);
  const PictureChange change = change_inside(both.traced, both.sure, {});
  EXPECT_LT(change.worst, rounding);
  const RayTotals &sure = both.sure_rays, &traced = both.traced_rays;
  EXPECT_EQ(sure.camera, traced.camera);
  EXPECT_EQ(sure.specular, traced.specular);
  EXPECT_EQ(traced.sure, 0U);
  const double share =
      static_cast<double>(sure.sure) / static_cast<double>(sure.camera + sure.specular);
  EXPECT_GE(share, min_sure);
}

TEST(CoherentBeams, ShowWhatRaysMeetInARoomWithAMirror) {
  expect_same(half_room(), look_at({1.7, 1.6, 2.7}, {0.2, 1.0, 0.8}, 1.0), 0.7);
  expect_same(half_room_with_small_mirror(), look_at({1.7, 1.6, 2.7}, {0.2, 1.0, 0.8}, 1.0), 0.7);
}

TEST(CoherentBeams, FollowFacingMirrors) {
  expect_same(facing_mirrors(Rgb(0.9, 0.8, 0.7)), look_at({0.5, 0.5, 0.5}, {0.45, 0.5, 0.0}, 1.2),
              0.4);
}

TEST(CoherentBeams, OfVeryWideViewsAreTheSame) {
  // The first tile goes far beyond the middle of the picture:
  // its last rays go back from the plane across its own middle.
  for (const double vertical_fov : {2.4, 2.6, 3.0})
    expect_same(half_room(), look_at({1.7, 1.6, 2.7}, {0.2, 1.0, 0.8}, vertical_fov), 0.2, 40);
}

TEST(CoherentBeams, OfParallelRaysAreTheSame) {
  Camera camera = look_at({1.8, 2.2, 2.8}, {0.1, 0.2, 0.4}, 1.0);
  camera.projection = Projection::orthographic;
  camera.half_height = 0.6;
  expect_same(half_room(), camera, 0.6);
}

TEST(CoherentBeams, StartAtASectionPlane) {
  // Walls with two sides: the plane cuts two of them and the box, and what is before it is not met.
  Scene scene = half_room();
  for (Material& material : scene.materials)
    material.double_sided = true;
  Camera camera = look_at({5.0, 3.0, 6.0}, {0.8, 1.0, 1.2}, 0.5);
  for (const double section : {5.0, 5.6, 6.2}) {
    camera.section = section;
    expect_same(scene, camera, 0.3);
  }
}

TEST(CoherentBeams, LookThroughBacksFromOutside) {
  // The walls between the eye and the room have their backs to it; through a mirror they are black.
  expect_same(half_room(), look_at({5.0, 3.0, 6.0}, {0.8, 1.0, 1.2}, 0.7), 0.6);
}

TEST(CoherentBeams, MissNoThinBarsNorSheetsNorHoles) {
  Scene scene = half_room();
  // Thinner than a pixel; in front of a wall by less than a margin;
  // two sides of a sheet; a plate across the mirror.
  add_polygon(scene, "bar",
              {{0.5, 0.0, 1.0}, {0.501, 0.0, 1.0}, {0.501, 2.4, 1.0}, {0.5, 2.4, 1.0}},
              double_sided(diffuse(0.3, 2.0)));
  add_polygon(scene, "decal",
              {{1.0, 0.5, 1e-6}, {1.4, 0.5, 1e-6}, {1.4, 0.9, 1e-6}, {1.0, 0.9, 1e-6}},
              diffuse(0.9));
  add_polygon(scene, "sheet", {{0.8, 1.2, 0.5}, {1.1, 1.2, 0.5}, {1.1, 1.6, 0.5}, {0.8, 1.6, 0.5}},
              diffuse(0.2));
  add_polygon(scene, "sheet.back",
              {{0.8, 1.2, 0.5}, {0.8, 1.6, 0.5}, {1.1, 1.6, 0.5}, {1.1, 1.2, 0.5}}, diffuse(0.8));
  add_polygon(scene, "plate",
              {{-0.1, 0.9, 1.5}, {0.3, 0.9, 1.5}, {0.3, 0.9, 1.9}, {-0.1, 0.9, 1.9}},
              double_sided(diffuse(0.5)));
  expect_same(scene, look_at({1.7, 1.6, 2.7}, {0.2, 1.0, 0.8}, 1.0), 0.5);
}

TEST(CoherentBeams, EdgeOnFromTheCornerOfATileIsNoDivisionByZero) {
  // The eye is as high as the box:
  // the middle of the picture, where four tiles meet, sees its lid edge on.
  Scene scene;
  add_room(
      scene, {-1, -1, -1}, {1, 1, 1},
      {diffuse(0.5), diffuse(0.4), diffuse(0.6), diffuse(0.5, 1.0), diffuse(0.7), diffuse(0.5)});
  add_box(scene, "box", {-0.3, -1, -0.3}, {0.3, 0.0, 0.3}, diffuse(0.3));
  expect_same(scene, look_at({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 1.5), 0.7);
}

} // namespace
} // namespace meninas::test
