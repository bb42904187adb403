// Flat metals that are nearly mirrors: mirrors in pass one, lobes in the picture.
#include "scenes/materials/smooth_surfaces.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/metals.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.target_elements = 300;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return settings;
}

/// The mean of a picture under a sky of radiance 1.
double mean_under_sky(Scene scene, const Camera& camera, int samples) {
  scene.background = Rgb(1.0);
  mark_smooth_surfaces(scene);
  RenderSettings settings;
  settings.width = settings.height = 8;
  settings.samples = samples;
  const Image image = picture(lit_up(scene, coarse()), camera, settings);
  double sum = 0.0;
  for (const auto& pixel : image.pixels)
    sum += double{pixel.g} / static_cast<double>(image.pixels.size());
  return sum;
}

TEST(SmoothMetalPictures, PassOneIsThatOfTheMirror) {
  const Scene ideal = half_room();
  Scene smooth = ideal;
  for (Material& material : smooth.materials)
    if (is_mirror(material))
      material.roughness = 0.1;
  Scene even = smooth;
  mark_smooth_surfaces(smooth);
  const auto light_of = [](const Scene& scene) {
    return lit_up(scene, coarse()).solution.field.irradiance;
  };
  EXPECT_EQ(light_of(ideal), light_of(smooth));
  EXPECT_NE(light_of(ideal).size(), light_of(even).size()) << "which spreads light by elements";
}

TEST(SmoothMetalPictures, WhiteUnderAWhiteSkyIsWhite) {
  Scene scene;
  add_polygon(scene, "plate", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
              metal(Rgb(1.0), 0.3));
  for (const Point3 eye : {Point3(0, 3, 0.1), Point3(0, 0.5, 3)})
    // No light is spread where there are no elements: the lobe has all of it.
    EXPECT_NEAR(mean_under_sky(scene, look_at(eye, Point3(0.0), 0.02), 1), 1.0, 1e-5) << eye.y;
}

TEST(SmoothMetalPictures, NoLightIsLostFromLobeToLobe) {
  // Between two plates close together a ray meets many lobes before it comes out.
  Scene scene;
  add_polygon(scene, "low", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
              metal(Rgb(1.0), 0.25));
  add_polygon(scene, "high", {{-1, 0.3, -1}, {1, 0.3, -1}, {1, 0.3, 1}, {-1, 0.3, 1}},
              metal(Rgb(1.0), 0.25));
  const Camera camera = look_at({0, 0.15, 3}, {0, 0, 0.7}, 0.02);
  // Of 64 times 256 paths, whose weights scatter by a tenth or so;
  // what is followed no further is below 1/1024.
  EXPECT_NEAR(mean_under_sky(scene, camera, 256), 1.0, 0.01);
}

/// A gloss floor before a wall of smooth metal,
/// with a lamp that the floor's lobes find by way of the wall alone, or a bulb.
Scene floor_and_wall(bool with_lamp) {
  Scene scene;
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
              metal(Rgb(0.8), 0.2));
  add_polygon(scene, "wall", {{-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}},
              metal(Rgb(0.9), 0.1));
  // Without it emitters were most of what has elements, and left to rays.
  add_polygon(scene, "black", {{-3, 3, -3}, {3, 3, -3}, {3, 3, 3}, {-3, 3, 3}}, diffuse(0.0));
  if (with_lamp) {
    // It faces the wall, and is small: found by points sooner than by rays.
    add_polygon(scene, "lamp", {{0.08, 0.9, 1}, {-0.08, 0.9, 1}, {-0.08, 1.06, 1}, {0.08, 1.06, 1}},
                diffuse(0.0, 10.0));
    return scene;
  }
  PunctualLight bulb;
  bulb.position = {0.5, 1.0, 0.2};
  bulb.intensity = Rgb(2.0);
  scene.lights = {bulb};
  return scene;
}

TEST(SmoothMetalPictures, LampsBehindALobeAreCountedOnce) {
  // Nothing reflects but lobes:
  // whatever pass one takes the wall for, the picture of the floor is the same.
  RenderSettings settings;
  settings.width = settings.height = 12;
  settings.samples = 256;
  settings.glossy_samples = 64;
  const Camera camera = look_at({0.0, 1.2, 2.0}, {0.0, 0.0, -0.4}, 0.25);
  const auto mean_of = [&](const Scene& scene) {
    const Image image = picture(lit_up(scene, coarse()), camera, settings);
    double sum = 0.0;
    for (const auto& pixel : image.pixels)
      sum += double{pixel.g} / static_cast<double>(image.pixels.size());
    return sum;
  };
  for (const bool with_lamp : {true, false}) {
    const Scene even = floor_and_wall(with_lamp);
    Scene smooth = even;
    mark_smooth_surfaces(smooth);
    ASSERT_TRUE(is_mirror(smooth.materials[0]) && is_mirror(smooth.materials[1]));
    const double wanted = mean_of(even);
    // What facets spread, a hundredth of the light and less,
    // is in the lobe of the one and even in the other.
    EXPECT_NEAR(mean_of(smooth), wanted, 0.02 * wanted) << with_lamp;
  }
}

} // namespace
} // namespace meninas::test
