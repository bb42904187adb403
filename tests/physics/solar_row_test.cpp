// What a panel has of the sun, straight and by a flat mirror before it:
//
//   H = DNI (sin(t + e) + rho sin(t - e)),   W/m^2,
//
// t the panel's tilt, e the sun's elevation, both facing south: the mirror shows a second sun at -e.
#include "radiosity/pass_one.h"
#include "radiosity/queries/point_light.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double tilt = 50.0 * degree, elevation = 25.0 * degree, dni = 800.0, reflectance = 0.9;

/// Of a panel by its number, `up` metres up its slope.
QueryPoint on_panel(int number, double up) {
  return {{1.1 * (number - 1) + 0.5, 0.3 + up * std::sin(tilt), -up * std::cos(tilt)},
          {0.0, std::cos(tilt), std::sin(tilt)}};
}

TEST(SolarRow, SunsOfPanelsStraightAndByTheMirror) {
  const auto file = std::filesystem::path(source_dir()) / "scenes/gallery/solar-row.gltf";
  MeshSettings mesh;
  mesh.element_size = 1.0;
  const auto l = lit(load_gltf(file), mesh);
  const std::vector<Rgb> black(element_count(l->mesh), Rgb(0.0));
  const double straight = dni * std::sin(tilt + elevation);
  const double mirrored = dni * reflectance * std::sin(tilt - elevation);
  for (const int number : {1, 2, 3, 4, 5, 6})
    for (const double up : {0.05, 0.8, 1.55}) {
      const PointIrradiance light =
          irradiance_at_points(*l->light, black, std::array{on_panel(number, up)}, {.rays = 256}).front();
      const double second = number > 2 ? mirrored : 0.0;
      // Corners and rays of the file are floats.
      EXPECT_NEAR(light.direct.g, straight + second, 1e-5 * straight) << number << ' ' << up;
      EXPECT_NEAR(light.by_mirrors.g, second, 1e-5 * straight) << number << ' ' << up;
    }
}

} // namespace
} // namespace meninas::test
