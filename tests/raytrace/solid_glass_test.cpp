// Solid glass in the picture: where it bends what is seen, and what is left of it.
#include "tests/raytrace/pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A wall of radiance 1 in the plane z = -1 to the right of `edge`,
/// and one of a tenth of it to the left, both far wider than what is seen.
Scene walls_with_edge(double edge) {
  Scene scene;
  add_polygon(scene, "right", {{edge, -9, -1}, {9, -9, -1}, {9, 9, -1}, {edge, 9, -1}},
              diffuse(0.0, pi));
  add_polygon(scene, "left", {{-9, -9, -1}, {edge, -9, -1}, {edge, 9, -1}, {-9, 9, -1}},
              diffuse(0.0, 0.1 * pi));
  return scene;
}

double seen(const Scene& scene, Point3 eye, Point3 target) {
  PassOneSettings pass_one;
  pass_one.mesh.element_size = 3.0;
  pass_one.form_factors.rays = pass_one.interpolation.rays = 16;
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 1;
  return double{picture(lit_up(scene, pass_one), look_at(eye, target, 1e-5), settings).pixels[0].g};
}

TEST(SolidGlass, ASlabShiftsWhatIsSeenThroughIt) {
  // Seen at an angle a, a slab of thickness t between parallel faces moves the line
  // of sight by d across it (glass_test.cpp), along the wall by d / cos a.
  constexpr double ior = 1.5, thickness = 0.4;
  const double a = 0.8, b = std::asin(std::sin(a) / ior);
  const double shift = thickness * std::sin(a) * (1.0 - std::cos(a) / (ior * std::cos(b)));
  const double face = face_reflectance(ior, std::cos(a));
  // The sum over all even numbers of reflections inside.
  const double passed = (1.0 - face) / (1.0 + face);
  const Point3 target(0.0, 0.0, -1.0), eye = target + 3.0 * Vec3(-std::sin(a), 0.0, std::cos(a));
  for (const double side : {-1.0, 1.0}) {
    // The line of sight comes from the left, steeper inside, and meets the wall before the target.
    Scene scene = walls_with_edge(-shift / std::cos(a) + 1e-3 * side);
    const double bare = seen(scene, eye, target);
    EXPECT_NEAR(bare, 1.0, 1e-6);
    add_box(scene, "slab", {-8, -8, -0.5}, {8, 8, -0.5 + thickness}, solid_glass(Rgb(1.0), ior));
    // What is reflected to and fro is seen further to the right.
    const double straight = (1.0 - face) * (1.0 - face);
    EXPECT_NEAR(seen(scene, eye, target),
                side < 0.0 ? passed : 0.1 * straight + (passed - straight), 3e-3)
        << side;
  }
}

TEST(SolidGlass, TakesItsPartByTheMetre) {
  Scene scene;
  add_polygon(scene, "wall", {{-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}},
              diffuse(0.0, pi));
  Material amber = solid_glass(Rgb(1.0));
  amber.attenuation_color = Rgb(0.5);
  amber.attenuation_distance = 0.25;
  add_box(scene, "slab", {-8, -8, -0.5}, {8, 8, 0.0}, amber);
  // Twice the distance to a half: a quarter, and 4 % at each face, of which some goes to and fro.
  EXPECT_NEAR(seen(scene, {0.1, 0.2, 1.0}, {0.1, 0.2, -1.0}),
              0.96 * 0.96 * 0.25 / (1.0 - 0.04 * 0.04 / 16.0), 1e-3);
}

TEST(SolidGlass, APrismReflectsAllOfIt) {
  // In through one leg, onto the face that is slanted by 45 degrees,
  // beyond the 41.8 of total reflection, and out through the other leg.
  // The prism is that over the triangle (0, 0), (1, 0), (1, 1) of the plane of y and z.
  const auto at = [](double y, double z, double x) { return Point3(x, y, z); };
  Scene scene;
  add_polygon(scene, "wall", {at(3, -4, -4), at(3, -4, 4), at(3, 4, 4), at(3, 4, -4)},
              diffuse(0.0, pi));
  const Material prism = solid_glass(Rgb(1.0));
  const Point3 a = at(0, 0, 1), b = at(1, 1, 1), c = at(1, 0, 1), back(-2, 0, 0);
  add_polygon(scene, "near", {a, a + back, c + back, c}, prism);
  add_polygon(scene, "upper", {c, c + back, b + back, b}, prism);
  add_polygon(scene, "slanted", {b, b + back, a + back, a}, prism);
  add_polygon(scene, "side", {a, c, b}, prism);
  add_polygon(scene, "other side", {a + back, b + back, c + back}, prism);
  // What the legs reflect inside goes back as it came, mostly to where nothing is.
  EXPECT_NEAR(seen(scene, at(0.6, -3.0, 0.1), at(0.6, 0.0, 0.1)), 0.96 * 0.96, 3e-3);
}

} // namespace
} // namespace meninas::test
