// Edges of lamps: a pixel shows as much white as it has of the lamp.
#include "image/display.h"
#include "raytrace/pixels/bright_edges.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

/// Black but for the half plane x < 0.3 y, which glows; a metre is seen across the picture, from 1 m.
Scene glowing_half() {
  Scene scene;
  add_polygon(scene, "lamp", {{-3, -2, 0}, {-0.6, -2, 0}, {0.6, 2, 0}, {-3, 2, 0}},
              diffuse(0.0, 3141.59));
  add_polygon(scene, "wall", {{-0.6, -2, 0}, {3, -2, 0}, {3, 2, 0}, {0.6, 2, 0}}, diffuse(0.5));
  return scene;
}

/// The part of the square of width w about (x, y) where x < 0.3 y.
double part_that_glows(double x, double y, double w) {
  constexpr int lines = 64;
  double sum = 0.0;
  for (int k = 0; k < lines; ++k) {
    const double edge = 0.3 * (y + w * ((k + 0.5) / lines - 0.5));
    sum += std::clamp((edge - x) / w + 0.5, 0.0, 1.0);
  }
  return sum / lines;
}

TEST(BrightEdges, PixelsShowAsMuchWhiteAsTheyHave) {
  PassOneSettings coarse;
  coarse.form_factors.rays = coarse.interpolation.rays = 16;
  const Taken taken = lit_up(glowing_half(), coarse);
  const Camera camera = look_at({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 2.0 * std::atan(0.5));
  constexpr int size = 24;
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.samples = 64;
  const Image before = render(taken.solution.field, camera, settings).image;
  for (const ViewTransform transform : {ViewTransform::srgb, ViewTransform::neutral}) {
    settings.display = DisplayChoice{.exposure = 0.0, .transform = transform};
    const Rendering shown = render(taken.solution.field, camera, settings);
    EXPECT_EQ(shown.image.pixels, before.pixels) << "light is what it was";
    const auto white = float(displayed(transform, glm::dvec3(1000.0)).g);
    std::size_t in_part = 0;
    for (const ShownPixel& pixel : shown.edges.pixels) {
      const double x = (double(pixel.pixel % size) + 0.5) / size - 0.5,
                   y = 0.5 - (double(pixel.pixel / size) + 0.5) / size;
      const double part = part_that_glows(x, y, 1.0 / size);
      // The points of a net of N tell the area beside a line to about N^(-3/4).
      EXPECT_NEAR(pixel.shown.g, part * double{white}, 1.1 * std::pow(settings.samples, -0.75))
          << x << ' ' << y;
      in_part += part > 0.01 && part < 0.99 ? 1 : 0;
    }
    EXPECT_GE(in_part, std::size_t{size}) << "the whole edge";
    EXPECT_LT(shown.edges.pixels.size(), std::size_t{6 * size}) << "and not much besides";
  }
}

// A lamp above the eye in a rough metal: its highlight has noise, and no part of a pixel is another thing.
TEST(BrightEdges, NoiseOfHighlightsIsNone) {
  Scene scene;
  Material rough = mirror(0.9);
  rough.roughness = 0.35;
  add_polygon(scene, "rug", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, rough);
  add_polygon(scene, "lamp", {{-0.3, 3, -1.3}, {0.3, 3, -1.3}, {0.3, 3, -0.7}, {-0.3, 3, -0.7}},
              diffuse(0.0, 100.0));
  PassOneSettings coarse;
  coarse.form_factors.rays = coarse.interpolation.rays = 16;
  RenderSettings settings;
  settings.width = settings.height = 24;
  settings.display = DisplayChoice{.exposure = 0.0, .transform = ViewTransform::neutral};
  const Taken taken = lit_up(scene, coarse);
  const Camera camera = look_at({0.0, 1.5, 1.5}, {0.0, 0.0, 0.0}, 0.7);
  settings.display->exposure = 1.0 + automatic_exposure(picture(taken, camera, settings));
  const Rendering shown = render(taken.solution.field, camera, settings);
  ASSERT_FALSE(shown.edges.pixels.empty()) << "or else nothing is tested";
  for (const ShownPixel& pixel : shown.edges.pixels) {
    const glm::dvec3 by_mean =
        displayed(ViewTransform::neutral, std::exp2(*settings.display->exposure) *
                                              glm::dvec3(shown.image.pixels[pixel.pixel]));
    EXPECT_NEAR(pixel.shown.g, by_mean.g, 1e-5) << pixel.pixel;
  }
}

TEST(BrightEdges, AreBetweenWhiteAndLess) {
  Image picture(7, 1);
  picture.pixels = {glm::vec3(0.1F),  glm::vec3(0.2F), glm::vec3(0.95F), glm::vec3(2.0F),
                    glm::vec3(1.8F), glm::vec3(3.0F), glm::vec3(3.0F)};
  // Also a pixel that is nearly white by its mean, between what is more and what is less.
  EXPECT_EQ(bright_edges(picture, 0.0), (PixelMask{0, 0, 1, 1, 1, 1, 0}));
  EXPECT_EQ(bright_edges(picture, 1.0), (PixelMask{0, 1, 1, 1, 1, 1, 0}));
  EXPECT_EQ(bright_edges(picture, -2.0), PixelMask(7, 0));
}

} // namespace
} // namespace meninas::test
