// Thin films in pass two: a plate below an even sky shows the film's reflectance at the angle of each
// look, in closed form.
#include "image/image_file.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/metals.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A plate in the plane y = 0 below a sky of radiance 1.
Scene plate(const Material& material) {
  Scene scene;
  add_polygon(scene, "plate", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, material);
  for (Vertex& v : scene.vertices)
    own_attributes(scene, v).texcoord[0] = {v.position.x / 4.0 + 0.5, v.position.z / 4.0 + 0.5};
  scene.background = Rgb(1.0);
  return scene;
}

Material film_on_metal(double roughness) {
  Material material = metal(Rgb(0.8, 0.7, 0.5), roughness);
  material.iridescence = 1.0;
  material.film_ior = 1.5;
  material.film_thickness = 500.0;
  return material;
}

/// The radiance of the plate's point at (x, 0, 0) from so many degrees off its normal.
Rgb seen(const Scene& scene, double degrees, double x = 0.0) {
  const double theta = degrees * std::numbers::pi / 180.0;
  PassOneSettings coarse;
  coarse.mesh.element_size = 0.5;
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 16;
  const Point3 eye(x, 2.0 * std::cos(theta), 2.0 * std::sin(theta));
  return picture(lit_up(scene, coarse), look_at(eye, Point3(x, 0.0, 0.0), 1e-4), settings)
      .pixels[0];
}

void expect_near(const Rgb& found, const Rgb& expected, double tolerance) {
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(found[band], expected[band], tolerance);
}

TEST(ThinFilms, OnAMirrorHaveTheColourOfEachAngle) {
  const Scene scene = plate(film_on_metal(0.0));
  for (const double degrees : {5.0, 40.0, 65.0, 80.0}) {
    const double cosine = std::cos(degrees * std::numbers::pi / 180.0);
    // Pixels are floats; a view of 1e-4 degrees has one angle.
    expect_near(seen(scene, degrees),
                film_reflectance({1.5, 500.0}, Rgb(0.8, 0.7, 0.5), cosine), 1e-5);
  }
}

// Nearly smooth metal: its facets lean by less than a degree.
TEST(ThinFilms, OnSatinMetalHaveTheColourOfTheirFacets) {
  const Scene scene = plate(film_on_metal(0.08));
  for (const double degrees : {5.0, 40.0, 65.0}) {
    const double cosine = std::cos(degrees * std::numbers::pi / 180.0);
    // Facets of alpha = 0.0064 spread the cosine by as much, of which the mean is second order.
    expect_near(seen(scene, degrees),
                film_reflectance({1.5, 500.0}, Rgb(0.8, 0.7, 0.5), cosine), 2e-3);
  }
}

// Thickness from a texture of two texels, black and white, at whose centres it is theirs.
TEST(ThinFilms, HaveTheThicknessOfTheirTexture) {
  Material material = film_on_metal(0.0);
  material.film_min_thickness = 200.0;
  material.film_thickness_texture = TextureUse{.texture = TextureId{0}};
  Scene scene = plate(material);
  Image halves(2, 1);
  halves.pixels = {Rgb(0.0), Rgb(1.0)};
  scene.textures.push_back({.name = "halves", .encoded = encode_png(halves, 0.0)});
  const double cosine = std::cos(0.5);
  for (const auto& [x, thickness] : {std::pair(-1.0, 200.0), std::pair(1.0, 500.0)})
    expect_near(seen(scene, 0.5 * 180.0 / std::numbers::pi, x),
                film_reflectance({1.5, thickness}, Rgb(0.8, 0.7, 0.5), cosine),
              2e-4); // texture coordinates are floats: beside a centre other texels have 1e-4 of a share
}

} // namespace
} // namespace meninas::test
