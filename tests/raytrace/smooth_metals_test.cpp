// Flat metals that are nearly mirrors: mirrors in pass one, lobes in the picture.
#include "scenes/smooth_metals.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

Material white_metal(double roughness) {
  Material material = mirror(1.0);
  material.roughness = roughness;
  return material;
}

PassOneSettings coarse() {
  PassOneSettings settings;
  settings.mesh.target_elements = 300;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  return settings;
}

/// The mean of a picture under a sky of radiance 1.
double mean_under_sky(Scene scene, const Camera& camera, int samples) {
  scene.background = Rgb(1.0);
  mark_smooth_metals(scene);
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
  mark_smooth_metals(smooth);
  const auto light_of = [](const Scene& scene) {
    return lit_up(scene, coarse()).solution.field.irradiance;
  };
  EXPECT_EQ(light_of(ideal), light_of(smooth));
  EXPECT_NE(light_of(ideal).size(), light_of(even).size()) << "which spreads light by elements";
}

TEST(SmoothMetalPictures, WhiteUnderAWhiteSkyIsWhite) {
  Scene scene;
  add_polygon(scene, "plate", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, white_metal(0.3));
  for (const Point3 eye : {Point3(0, 3, 0.1), Point3(0, 0.5, 3)})
    // No light is spread where there are no elements: the lobe has all of it.
    EXPECT_NEAR(mean_under_sky(scene, look_at(eye, Point3(0.0), 0.02), 1), 1.0, 1e-5) << eye.y;
}

TEST(SmoothMetalPictures, NoLightIsLostFromLobeToLobe) {
  // Between two plates close together a ray meets many lobes before it comes out.
  Scene scene;
  add_polygon(scene, "low", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, white_metal(0.25));
  add_polygon(scene, "high", {{-1, 0.3, -1}, {1, 0.3, -1}, {1, 0.3, 1}, {-1, 0.3, 1}},
              white_metal(0.25));
  const Camera camera = look_at({0, 0.15, 3}, {0, 0, 0.7}, 0.02);
  // Of 64 times 256 paths, whose weights scatter by a tenth or so; what is followed no further is below 1/1024.
  EXPECT_NEAR(mean_under_sky(scene, camera, 256), 1.0, 0.01);
}

/// A gloss floor before a wall of smooth metal, both alone with a lamp and a bulb.
Scene floor_and_wall() {
  Scene scene;
  Material floor = mirror(0.8), wall = mirror(0.9);
  floor.roughness = 0.25;
  wall.roughness = 0.1;
  add_polygon(scene, "floor", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, floor);
  add_polygon(scene, "wall", {{-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}}, wall);
  add_polygon(scene, "lamp", {{-0.3, 1.4, 0}, {0.3, 1.4, 0}, {0.3, 1.4, 0.6}, {-0.3, 1.4, 0.6}},
              diffuse(0.0, 10.0));
  PunctualLight bulb;
  bulb.position = {0.5, 1.0, 0.2};
  bulb.intensity = Rgb(2.0);
  scene.lights = {bulb};
  return scene;
}

TEST(SmoothMetalPictures, LampsBehindALobeAreCountedOnce) {
  // Nothing reflects but lobes: whatever pass one takes the wall for, the picture is the same.
  RenderSettings settings;
  settings.width = settings.height = 12;
  settings.samples = 256;
  settings.glossy_samples = 64;
  const Camera camera = look_at({0.2, 1.2, 2.0}, {0.0, 0.1, -0.3}, 0.5);
  const auto mean_of = [&](const Scene& scene) {
    const Image image = picture(lit_up(scene, coarse()), camera, settings);
    double sum = 0.0;
    for (const auto& pixel : image.pixels)
      sum += double{pixel.g} / static_cast<double>(image.pixels.size());
    return sum;
  };
  Scene smooth = floor_and_wall();
  mark_smooth_metals(smooth);
  ASSERT_TRUE(is_mirror(smooth.materials[0]) && is_mirror(smooth.materials[1]));
  const double even = mean_of(floor_and_wall());
  // What facets spread, a hundredth of the light and less, is in the lobe of the one and even in the other.
  EXPECT_NEAR(mean_of(smooth), even, 0.02 * even);
}

} // namespace
} // namespace meninas::test
