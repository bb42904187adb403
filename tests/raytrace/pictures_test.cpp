#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace meninas::test {
namespace {

RenderSettings picture_size() {
  RenderSettings settings;
  settings.width = 160;
  settings.height = 120;
  settings.samples = 16;
  return settings;
}

PassOneSettings pass_one(double element_size, int rays) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = rays;
  return settings;
}

TEST(Pictures, SameBitsForAnyThreadCountAndRun) {
  const Scene scene = half_room_with_small_mirror();
  std::vector<Image> images;
  for (const std::size_t threads : {1, 2, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(picture(lit_up(scene, pass_one(0.2, 64)), scene.cameras[0], picture_size()));
  }
  EXPECT_EQ(images[0].pixels, images[1].pixels);
  EXPECT_EQ(images[0].pixels, images[2].pixels);
}

// With the mirror, the picture of the half room is that of the doubled room,
// in which the images are really there. Left out are pixels at edges, by the rule of edges():
// mirror edges are among them, where the sample grid decides which pixels are mirror.
class PictureOfImages : public testing::TestWithParam<bool> {
protected:
  Scene half = GetParam() ? half_room_with_small_mirror() : half_room();

  /// How the picture of the half room differs from that of the doubled one, edges aside.
  PictureChange difference(const PassOneSettings& settings,
                           const RenderSettings& size = picture_size()) const {
    const Camera camera = half.cameras[0];
    const Image with_mirror = picture(lit_up(half, settings), camera, size);
    const Image without = picture(lit_up(doubled(half), settings), camera, size);
    return change_inside(without, with_mirror, edges(half, camera, size));
  }
};

// Finely sampled, so that sampling noise is below what is asked: then no pixel is off by 1 %, but for
// some at the foot of the box, whose light comes along lines to the contact: these carry what the
// ends are off by, times up to five, to vertices beyond it.
TEST_P(PictureOfImages, PixelByPixel) {
  PassOneSettings settings = pass_one(0.25, 4096);
  settings.direct.shadow_rays = 64;
  settings.direct.penumbra_rays = 1024;
  settings.interpolation.cluster_shadow_rays = 16;
  const PictureChange c = difference(settings);
  EXPECT_GT(c.pixels, 160U * 120U * 8U / 10U);
  EXPECT_LE(c.beyond_a_hundredth, 4U);
  EXPECT_LT(c.worst, 0.015);
  EXPECT_LT(c.rms, 0.002);
}

// Lamps without extent under a sky: the image of a lamp is another lamp, behind an opening
// where the mirror is. Their light is exact; that of the sky is sampled.
TEST_P(PictureOfImages, LampsAndSky) {
  half.lights = {{.name = "bulb", .intensity = Rgb(3.0, 2.0, 1.0), .position = {1.7, 2.0, 2.6}},
                 {.name = "spot",
                  .kind = PunctualKind::spot,
                  .intensity = Rgb(9.0),
                  .position = {1.8, 2.2, 0.4},
                  .direction = glm::normalize(Vec3(-1.8, -1.0, 0.7)),
                  .inner_cone = 0.2,
                  .outer_cone = 0.5}};
  half.background = Rgb(0.2, 0.4, 0.8);
  for (Material& material : half.materials)
    material.emission = Rgb(0.0);
  std::erase_if(half.triangles, [&](const Triangle& triangle) {
    return half.nodes[index(triangle.node)].name == "z1"; // lets the sky in
  });
  // By a window, which is there twice in the doubled room, and so an emitter as the images of the lamps are.
  add_polygon(half, "lintel", {{0, 1.2, 3}, {0, 2.4, 3}, {2, 2.4, 3}, {2, 1.2, 3}}, diffuse(0.5));
  add_polygon(half, "jamb", {{0, 0, 3}, {0, 1.2, 3}, {0.4, 1.2, 3}, {0.4, 0, 3}}, diffuse(0.5));
  RenderSettings size = picture_size();
  size.diffuse.term = DiffuseTerm::direct;
  size.diffuse.refinement.tolerance = 0.004; // of smooth light, of which a hundredth is asked here
  size.diffuse.refinement.penumbra_rays = 1024;
  const PictureChange c = difference(pass_one(0.25, 4096), size);
  EXPECT_GT(c.pixels, 160U * 120U * 8U / 10U);
  EXPECT_LT(double(c.beyond_a_hundredth), 0.002 * double(c.pixels)); // at the edges of shadows
  EXPECT_LT(c.rms, 0.004);
}

// With the settings as they come, noise of the gather rays and penumbrae leave some pixels apart.
TEST_P(PictureOfImages, DefaultSettings) {
  const PictureChange c = difference(pass_one(0.1, FormFactorSettings{}.rays));
  EXPECT_LT(c.rms, 0.006);
  EXPECT_LT(double(c.beyond_a_hundredth), 0.04 * double(c.pixels));
  EXPECT_LT(c.worst, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Mirrors, PictureOfImages, testing::Values(false, true),
                         [](const auto& which) {
                           return which.param ? "PartOfTheWall" : "WholeWall";
                         });

// Scale, place and orientation change nothing but roundings,
// which decide only where a sample meets an edge: no other pixel changes by 1 %.
TEST(Pictures, ScalePlaceAndOrientation) {
  const Scene scene = half_room_with_small_mirror();
  const Image before =
      picture(lit_up(scene, pass_one(0.15, 128)), scene.cameras[0], picture_size());
  const auto left_out = edges(scene, scene.cameras[0], picture_size());
  const glm::dmat3 straight(1.0),
      turned(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(Vec3(-0.4, 1.0, 0.2))));
  struct Move {
    glm::dmat3 rotation;
    double scale;
    Vec3 offset;
  };
  for (const Move& move : {Move{straight, 1e-4, Vec3(0.0)}, Move{straight, 1e4, Vec3(0.0)},
                           Move{straight, 1.0, {3e4, -2e4, 1e4}}, Move{turned, 1.0, Vec3(0.0)},
                           Move{turned, 1e4, {1e8, 3e8, -2e8}}}) {
    const Scene moved = transformed(scene, move.rotation, move.scale, move.offset);
    const Image after =
        picture(lit_up(moved, pass_one(0.15 * move.scale, 128)), moved.cameras[0], picture_size());
    const PictureChange inside = change_inside(before, after, left_out);
    EXPECT_EQ(inside.beyond_a_hundredth, 0U) << move.scale;
    EXPECT_LT(inside.worst, 0.01) << move.scale;
  }
}

} // namespace
} // namespace meninas::test
