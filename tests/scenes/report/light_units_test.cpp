#include "scenes/report/light_units.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A room of 4 m x 2.5 m x 5 m, 85 m^2, with a panel of radiance L, 1 m^2, and a bulb of I W/sr.
Scene lit_room(double radiance, double intensity, PunctualKind kind = PunctualKind::point) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.7));
  add_room(scene, Point3(0.0), {4.0, 2.5, 5.0}, walls);
  add_polygon(scene, "panel", {{1, 2.4, 1}, {2, 2.4, 1}, {2, 2.4, 2}, {1, 2.4, 2}},
              diffuse(0.0, std::numbers::pi * radiance));
  PunctualLight light;
  light.kind = kind;
  light.intensity = Rgb(intensity);
  light.outer_cone = std::acos(0.9); // a twentieth of all directions
  scene.lights.push_back(light);
  return scene;
}

TEST(LightUnits, CandelaBesideRadianceAreNamed) {
  // 60 W of light evenly to all sides is 4.8 W/sr, in the file 683 times that.
  const auto said = describe_mixed_units(lit_room(10.0, 683.0 * 4.8));
  ASSERT_TRUE(said);
  EXPECT_THAT(*said, testing::HasSubstr("--light-scale 0.001464"));
  EXPECT_FALSE(describe_mixed_units(lit_room(10.0, 4.8)));
}

TEST(LightUnits, TheBoundsAreThoseOfTheRule) {
  // H = 4 pi I / 86 m^2: 100 W/m^2 with I = 684.4 W/sr, as bright as a panel of 31.8 W/m^2/sr.
  const double of_hundred = 100.0 * 86.0 / (4.0 * std::numbers::pi);
  EXPECT_TRUE(describe_mixed_units(lit_room(1.0, 1.01 * of_hundred)));
  EXPECT_FALSE(describe_mixed_units(lit_room(1.0, 0.99 * of_hundred))) << "as light as rooms are";
  EXPECT_TRUE(describe_mixed_units(lit_room(31.8, 1.01 * of_hundred)));
  EXPECT_FALSE(describe_mixed_units(lit_room(32.5, 1.01 * of_hundred))) << "a lamp that looks like one";
  const auto spot = [&](double intensity) {
    return describe_mixed_units(lit_room(1.0, intensity, PunctualKind::spot));
  };
  EXPECT_TRUE(spot(20.2 * of_hundred));
  EXPECT_FALSE(spot(19.8 * of_hundred));
}

TEST(LightUnits, OrdinaryScenesAreNotNamed) {
  EXPECT_FALSE(describe_mixed_units(lit_room(0.0, 1e6))) << "nothing glows beside it";
  EXPECT_FALSE(describe_mixed_units(lit_room(1.0, 0.0)));
  EXPECT_FALSE(describe_mixed_units(lit_room(1.0, 1e5, PunctualKind::directional)))
      << "by day lamps are darker than walls";
  EXPECT_FALSE(describe_mixed_units(lit_room(3000.0, 683.0 * 4.8))) << "all of it in candela";
}

} // namespace
} // namespace meninas::test
