#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.element_size = 0.25;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return settings;
}

RenderSettings size(int width, int height, int samples = 16) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = samples;
  return settings;
}

/// An emitter of radiance (1, 2, 3) that fills the plane z = 0, seen from +z.
Scene glowing_wall() {
  Scene scene;
  Material glow = diffuse(0.0);
  glow.emission = Rgb(1.0, 2.0, 3.0);
  add_polygon(scene, "wall", {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, glow);
  return scene;
}

void expect_everywhere(const Image& image, const glm::vec3& radiance) {
  for (const auto& pixel : image.pixels) // a mean of floats of one value
    EXPECT_LE(glm::distance(pixel, radiance), 1e-5F * glm::length(radiance));
}

TEST(Radiance, AnEmitterHasItsRadiance) {
  const Taken scene = lit_up(glowing_wall(), coarse());
  expect_everywhere(picture(scene, look_at({0, 0, 2}, Point3(0.0), 0.8), size(33, 17)), {1, 2, 3});
}

TEST(Radiance, ADiffuseWallHasReflectanceTimesIrradianceOverPi) {
  // In a furnace of E = 1, rho = 1/2: B = 2, so L = 2 / pi.
  PassOneSettings settings = coarse();
  settings.solver.tolerance = 1e-6;
  const Taken scene = lit_up(furnace(0.5, {false, true}), settings);
  const Image image = picture(scene, look_at({0.4, 0.5, 0.9}, {0.6, 0.4, 0.0}, 1.5), size(32, 32));
  for (const auto& pixel : image.pixels)
    EXPECT_NEAR(pixel.g, 2.0 / std::numbers::pi, 1e-4);
}

TEST(Radiance, AMirrorShowsReflectanceTimesRadiance) {
  Scene scene = glowing_wall();
  Material glass = mirror(1.0);
  glass.base_color = Rgb(0.9, 0.5, 0.1);
  add_polygon(scene, "mirror", {{5, -5, 4}, {-5, -5, 4}, {-5, 5, 4}, {5, 5, 4}}, glass);
  expect_everywhere(
      picture(lit_up(scene, coarse()), look_at({0, 0, 2}, {0, 0, 4}, 0.8), size(17, 33)),
      {0.9, 1.0, 0.3});
}

TEST(Radiance, MirrorsAreBlackInRadiosityMode) {
  Scene scene = glowing_wall();
  add_polygon(scene, "mirror", {{5, -5, 4}, {-5, -5, 4}, {-5, 5, 4}, {5, 5, 4}}, mirror(0.9));
  RenderSettings settings = size(16, 16);
  settings.mode = RenderMode::radiosity;
  const Taken taken = lit_up(scene, coarse());
  const Rendering rendering = render(taken.solution.field,
                                     look_at({0, 0, 2}, {0, 0, 4}, 0.8), settings);
  expect_everywhere(rendering.image, glm::vec3(0.0F));
  EXPECT_EQ(rendering.specular_rays, 0U);
  EXPECT_EQ(rendering.camera_rays, 16U * 16U * 16U);
}

TEST(Radiance, BacksAreTransparentToTheEyeAndBlackInMirrors) {
  Scene scene = glowing_wall();
  add_polygon(scene, "screen", {{5, -5, 1}, {-5, -5, 1}, {-5, 5, 1}, {5, 5, 1}},
              diffuse(0.5)); // faces the wall
  const Camera camera = look_at({0, 0, 2}, Point3(0.0), 0.8);
  expect_everywhere(picture(lit_up(scene, coarse()), camera, size(8, 8)), {1, 2, 3});
  // By way of a mirror the back of the screen is what it is: black.
  add_polygon(scene, "mirror", {{5, -5, 4}, {-5, -5, 4}, {-5, 5, 4}, {5, 5, 4}}, mirror(0.9));
  expect_everywhere(
      picture(lit_up(scene, coarse()), look_at({0, 0, 2}, {0, 0, 4}, 0.8), size(8, 8)),
      glm::vec3(0.0F));
}

TEST(Radiance, NothingIsBlack) {
  const Taken scene = lit_up(glowing_wall(), coarse());
  expect_everywhere(picture(scene, look_at({0, 0, 2}, {0, 0, 4}, 0.8), size(5, 5)),
                    glm::vec3(0.0F));
}

TEST(Radiance, OnePixelAndOddSizes) {
  const Taken scene = lit_up(half_room(), coarse());
  const Camera camera = half_room().cameras[0];
  const Image one = picture(scene, camera, size(1, 1, 1 << 16));
  ASSERT_EQ(one.pixels.size(), 1U);
  // One pixel of the picture is the mean of a larger one of the same view.
  const Image many = picture(scene, camera, size(65, 65, 4));
  glm::dvec3 mean(0.0);
  for (const auto& pixel : many.pixels)
    mean += glm::dvec3(pixel) / double(many.pixels.size());
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(one.pixels[0][band], mean[band],
                0.01 * mean[band]); // the lamp, 1 % of the picture, makes a quarter of it
  for (const auto& [w, h] : {std::pair(33, 17), std::pair(1, 40), std::pair(97, 3)}) {
    const Image image = picture(scene, camera, size(w, h, 1));
    ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(w * h));
    for (const auto& pixel : image.pixels)
      EXPECT_TRUE(std::isfinite(pixel.r) && pixel.r >= 0.0F);
  }
}

TEST(Radiance, RowsRunFromTheTop) {
  Scene scene;
  add_polygon(scene, "upper left", {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}},
              diffuse(Rgb(0.0), Rgb(std::numbers::pi)));
  const Image image = picture(lit_up(scene, coarse()),
                              look_at({0, 0, 1}, Point3(0.0), std::numbers::pi / 2), size(8, 8));
  EXPECT_NEAR(image.at(1, 1).g, 1.0F, 1e-5F);
  EXPECT_EQ(image.at(6, 1).g, 0.0F);
  EXPECT_EQ(image.at(1, 6).g, 0.0F);
}

TEST(Radiance, OrthographicSeesTrueSizes) {
  // A square of 1 m in a picture 4 m high and 8 m wide:
  // exactly 1/4 of the height, 1/8 of the width, however far away.
  Scene scene;
  for (const double z : {0.0, -100.0}) {
    const double x = z == 0.0 ? 0.0 : 2.0;
    add_polygon(scene, "square", {{x, 0, z}, {x + 1, 0, z}, {x + 1, 1, z}, {x, 1, z}},
                diffuse(Rgb(0.0), Rgb(std::numbers::pi)));
  }
  Camera camera = look_at({0, 0, 3}, Point3(0.0), 0.8);
  camera.projection = Projection::orthographic;
  camera.half_height = 2.0;
  const Image image = picture(lit_up(scene, coarse()), camera, size(64, 32));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool inside = y >= 8 && y < 16 && ((x >= 32 && x < 40) || (x >= 48 && x < 56));
      EXPECT_NEAR(image.at(x, y).r, inside ? 1.0F : 0.0F, 1e-5F) << x << ' ' << y;
    }
}

// The k-th image of a lamp between facing mirrors is seen through k reflections:
// its radiance is rho^k L, and nothing else.
TEST(RadianceBetweenMirrors, TheKthImageHasReflectanceToTheKth) {
  const Rgb rho(0.98, 0.9, 0.7);
  const Taken scene = lit_up(facing_mirrors(rho), coarse());
  for (int k = -30; k <= 30; ++k) {
    // Lamps at z = k + 1/2 of unfolded space;
    // the corridor between the mirrors has no walls across it.
    const Point3 eye{0.5, 0.3, 0.5};
    const Camera camera = look_at(eye, {0.5, 0.99, k + 0.5 + 1e-9}, 1e-4);
    RenderSettings settings = size(3, 3, 4);
    settings.min_throughput = 1e-6;
    Camera steep = camera;
    if (k == 0) {
      steep.forward = {0, 1, 0};
      steep.right = {1, 0, 0};
      steep.up = {0, 0, 1};
    }
    for (const auto& pixel : picture(scene, steep, settings).pixels)
      for (int band = 0; band < 3; ++band) {
        const double exact = std::pow(rho[band], std::abs(k));
        EXPECT_NEAR(pixel[band], exact, 1e-5 * exact) << k; // k products of floats
      }
  }
}

TEST(RadianceBetweenMirrors, PathsEndBelowTheVisibleThreshold) {
  const Taken scene = lit_up(facing_mirrors(Rgb(1.0)), coarse());
  // Straight into perfect mirrors a ray never ends by itself:
  // the picture is black there, and finished.
  Camera camera = look_at({0.5, 0.3, 0.5}, {0.5, 0.3, 0.0}, 1e-7);
  const Image image = picture(scene, camera, size(2, 2, 1));
  for (const auto& pixel : image.pixels)
    EXPECT_TRUE(std::isfinite(pixel.r));
}

} // namespace
} // namespace meninas::test
