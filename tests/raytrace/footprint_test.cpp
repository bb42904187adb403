// Textures seen from afar: means without moire, straight, in mirrors and at grazing angles.
#include "image/image_file.h"
#include "raytrace/two_pass.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

constexpr double reflectance = 0.8;

/// Squares (or, `striped`, columns) of black and white, n to a side, eight texels wide.
Texture pattern(int n, bool striped) {
  Image image(8 * n, 8 * n);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = glm::vec3((x / 8 + (striped ? 0 : y / 8)) % 2 == 0 ? 1.0F : 0.0F);
  return {.name = "pattern", .encoded = encode_png(image, 0.0)};
}

/// The unit square in y = 0 under a sky of radiance 1, so that its radiance is its reflectance.
/// Textures run along x and z.
Scene floor_with(const Texture& texture, const std::string& name = "floor") {
  Scene scene;
  scene.textures = {texture};
  scene.background = Rgb(1.0);
  Material paint = diffuse(reflectance);
  paint.base_color_texture = TextureUse{.texture = TextureId{0}};
  add_polygon(scene, name, {{-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}, {-0.5, 0, -0.5}}, paint);
  for (Vertex& vertex : scene.vertices)
    own_attributes(scene, vertex).texcoord[0] =
        glm::vec2(vertex.position.x, vertex.position.z) + 0.5F;
  return scene;
}

Image seen(const Scene& scene, const Camera& camera, int size, int samples = 1,
           double pixel_error = 0.0) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.5;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 16;
  settings.render.width = settings.render.height = size;
  settings.render.samples = samples;
  settings.render.pixel_error = pixel_error;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  return two_pass(*prepared, camera, settings).rendering.image;
}

struct Spread {
  double low = 1e9, high = 0.0;
};
/// Of the pixels `border` away from the picture's edge.
Spread spread_of(const Image& image, int border) {
  Spread spread;
  for (int y = border; y < image.height - border; ++y)
    for (int x = border; x < image.width - border; ++x) {
      spread.low = std::min(spread.low, double{image.at(x, y).g});
      spread.high = std::max(spread.high, double{image.at(x, y).g});
    }
  return spread;
}

/// From above, the floor as wide as the picture.
Camera above() { return look_at({0.0, 10.0, 1e-3}, {0.0, 0.0, 0.0}, 2.0 * std::atan(0.05)); }

TEST(Footprint, SquaresFarAwayAreTheirMean) {
  // One sample stands for 8 by 8 squares and a third, off their grid:
  // unfiltered it would be black or white.
  const Spread spread = spread_of(seen(floor_with(pattern(64, false)), above(), 15), 1);
  EXPECT_NEAR(spread.low, 0.5 * reflectance, 0.02 * reflectance);
  EXPECT_NEAR(spread.high, 0.5 * reflectance, 0.02 * reflectance);
}

TEST(Footprint, SquaresLargerThanPixelsAreAsTheyAre) {
  const Image image = seen(floor_with(pattern(4, false)), above(), 32);
  // Pixel (4, 4) is the middle of the first square, which is 8 pixels wide.
  EXPECT_NEAR(image.at(4, 4).g, reflectance, 1e-4);
  EXPECT_NEAR(image.at(12, 4).g, 0.0, 1e-4);
}

TEST(Footprint, MoreSamplesAreSharper) {
  // A square is a pixel. Of one sample a pixel, level and texels blur into the neighbours;
  // of 64 almost none do.
  const auto contrast = [](int samples) {
    const Spread spread = spread_of(seen(floor_with(pattern(16, false)), above(), 16, samples), 1);
    return (spread.high - spread.low) / reflectance;
  };
  // Between squares of eight texels a look-up rises over one:
  // each axis loses a quarter texel at either side.
  EXPECT_NEAR(contrast(64), std::pow(1.0 - 0.5 / 8.0, 2.0), 0.02);
  EXPECT_GT(contrast(64), contrast(1));
}

TEST(Footprint, WhereSamplesAreChosenTheLaterOnesAreSharperToo) {
  // Footprints half a pixel wide, of four samples, blur the squares by 0.17 more than those of 64,
  // and of 16 by 0.07. Of 64 samples in rounds four have the former and twelve the latter:
  // 0.024 in all. It was 0.17, with the first samples' footprint for all.
  const Scene scene = floor_with(pattern(16, false));
  const Image at_once = seen(scene, above(), 16, 64), chosen = seen(scene, above(), 16, 64, 1e-6);
  for (int y = 1; y < 15; ++y)
    for (int x = 1; x < 15; ++x)
      EXPECT_NEAR(chosen.at(x, y).g, at_once.at(x, y).g, 0.03 * reflectance) << x << " " << y;
}

TEST(Footprint, InAMirrorItIsThatOfTheUnfoldedWay) {
  Scene scene = floor_with(pattern(64, false));
  add_polygon(scene, "mirror", {{-50, 20, -50}, {50, 20, -50}, {50, 20, 50}, {-50, 20, 50}},
              mirror(1.0));
  scene.background = Rgb(0.0);
  scene.materials[0].emission = Rgb(1.0);
  scene.materials[0].base_color = Rgb(0.0);
  scene.materials[0].emissive_texture = scene.materials[0].base_color_texture;
  // From half way up, straight up into the mirror: 30 away from the floor, which fills the picture.
  const Camera up = look_at({0.0, 10.0, 0.0}, {1e-4, 20.0, 0.0}, 2.0 * std::atan(0.5 / 30.0));
  const Spread spread = spread_of(seen(scene, up, 15), 1);
  EXPECT_NEAR(spread.low, 0.5, 0.02);
  EXPECT_NEAR(spread.high, 0.5, 0.02);
}

TEST(Footprint, OfAnOrthographicCameraToo) {
  Camera camera = look_at({0.0, 1e4, 1e-3}, {0.0, 0.0, 0.0}, 0.1);
  camera.projection = Projection::orthographic;
  camera.half_height = 0.5;
  const Spread far = spread_of(seen(floor_with(pattern(64, false)), camera, 15), 1);
  EXPECT_NEAR(far.low, 0.5 * reflectance, 0.02 * reflectance);
  EXPECT_NEAR(far.high, 0.5 * reflectance, 0.02 * reflectance);
}

TEST(Footprint, AtGrazingAnglesItIsLongNotWide) {
  // Stripes that run away from the eye, 16 to the floor;
  // the footprint is ten times as long as wide. Filtered as wide as long, they would be grey.
  const double height = 0.2, away = 2.0;
  const Camera camera = look_at({0.0, height, away}, {0.0, 0.0, 0.0}, 0.02);
  Image image = seen(floor_with(pattern(16, true)), camera, 16, 4);
  double low = 1.0, high = 0.0;
  for (int x = 0; x < 16; ++x) {
    low = std::min(low, double{image.at(x, 8).g});
    high = std::max(high, double{image.at(x, 8).g});
  }
  EXPECT_LT(low, 0.05 * reflectance);
  EXPECT_GT(high, 0.95 * reflectance);
}

} // namespace
} // namespace meninas::test
