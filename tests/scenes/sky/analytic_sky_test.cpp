// Skies by formula: horizontal irradiances against closed forms, published zenith values, the sun.
#include "scenes/sky/analytic_sky.h"
#include "scenes/photometry.h"
#include "scenes/sky/preetham.h"
#include "scenes/sky/sun_light.h"
#include "scenes/sky/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

/// Luminance of the map in W/m^2/sr.
double seen(const AnalyticSky& sky, const Vec3& direction) {
  return luminance_of(radiance_from(sky.map, direction, Suns::shown));
}

/// Integral of L cos over the upper hemisphere, by midpoints in the elevation's sine squared.
double integrated(const SkySettings& sky) {
  constexpr int rings = 400, steps = 400;
  double sum = 0.0;
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < steps; ++i) {
      const double y = std::sqrt((j + 0.5) / rings), r = std::sqrt(1.0 - y * y);
      const double phi = 2.0 * pi * (i + 0.5) / steps;
      sum += luminance_of(
          glm::vec3(relative_radiance(sky, {r * std::cos(phi), y, r * std::sin(phi)})));
    }
  return pi * sum / (rings * steps);
}

TEST(AnalyticSkies, UniformIrradianceIsPiL) {
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::uniform, .illuminance = 683.0}, {});
  EXPECT_NEAR(pi * seen(sky, {0.3, 0.5, 0.1}), 1.0, 1e-5);
  EXPECT_NEAR(horizontal_irradiance(sky.map).g, 1.0, 1e-5);
  EXPECT_NEAR(seen(sky, {0.3, -0.1, 0.1}), ground_reflectance / pi, 1e-5);
}

TEST(AnalyticSkies, OvercastIrradianceIsSevenNinthsOfPiTimesTheZenith) {
  const SkySettings overcast{.kind = SkyKind::overcast, .illuminance = {}};
  EXPECT_NEAR(integrated(overcast), 7.0 * pi / 9.0, 1e-4);
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::overcast, .illuminance = 683.0}, {});
  EXPECT_NEAR(horizontal_irradiance(sky.map).g, 1.0, 1e-5);
  const double zenith = seen(sky, {0, 1, 0});
  EXPECT_NEAR(7.0 * pi / 9.0 * zenith, 1.0, 1e-3);
  // A third of the zenith at the horizon, which is an edge.
  EXPECT_NEAR(seen(sky, {1.0, 1e-4, 0.0}) / zenith, 1.0 / 3.0, 3e-3);
  EXPECT_NEAR(seen(sky, {1.0, -1e-4, 0.0}), ground_reflectance / pi, 1e-5);
}

TEST(AnalyticSkies, TenThousandLuxIsTheUsualOvercastSky) {
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::overcast, .illuminance = {}}, {});
  EXPECT_NEAR(lux_per_watt * horizontal_irradiance(sky.map).g, 10'000.0, 0.1);
  EXPECT_FALSE(sky.sun.has_value());
}

TEST(AnalyticSkies, ClearSkyFollowsKittler) {
  const Direction sun = direction_of({.azimuth = 90.0, .elevation = 40.0});
  const SkySettings clear{.kind = SkyKind::clear, .sun = sun, .illuminance = {}};
  // At the zenith 1; at 60 degrees from it opposite the sun, by hand:
  // s = 110 degrees, f = 0.91 + 10 exp(-3 s) + 0.45 cos^2 s, phi = 1 - exp(-0.32 / cos 60).
  EXPECT_NEAR(relative_radiance(clear, {0, 1, 0}).g, 1.0, 1e-12);
  const double s = 110.0 * degree, zenith = 50.0 * degree;
  const auto f = [](double x) {
    return 0.91 + 10.0 * std::exp(-3.0 * x) + 0.45 * std::pow(std::cos(x), 2);
  };
  const double expected =
      f(s) * (1.0 - std::exp(-0.64)) / (f(zenith) * (1.0 - std::exp(-0.32)));
  EXPECT_NEAR(relative_radiance(clear, {-std::sin(60.0 * degree), 0.5, 0.0}).g, expected, 1e-9);
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::clear, .sun = sun, .illuminance = 12'000.0}, {});
  EXPECT_NEAR(lux_per_watt * horizontal_irradiance(sky.map).g, 12'000.0, 0.2);
  ASSERT_TRUE(sky.sun.has_value());
  EXPECT_GT(glm::dot(sky.sun->towards, sun), 1.0 - 1e-12);
}

TEST(AnalyticSkies, PreethamsZenithIsThatOfHisFormulae) {
  // T = 2, sun 45 degrees from the zenith, worked out by hand from appendix A.2:
  // chi = (4/9 - 2/120) pi / 2 = 0.671952, tan = 0.79543; Y = 3.1196 * 0.79543 + 1.9882.
  const SkyColour zenith = preetham_zenith(2.0, 0.25 * pi);
  EXPECT_NEAR(zenith.luminance, 4.46964, 5e-5);
  const double s = 0.25 * pi, s2 = s * s, s3 = s2 * s;
  EXPECT_NEAR(zenith.x,
              4.0 * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                  2.0 * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                  (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886),
              1e-12);
  // The same summed by hand, to their digits: deep blue.
  EXPECT_NEAR(zenith.x, 0.24095, 1e-5);
  EXPECT_NEAR(zenith.y, 0.24372, 1e-5);
}

TEST(AnalyticSkies, PreethamIsTheZenithAboveAndBluerAwayFromTheSun) {
  const Direction sun = direction_of({.azimuth = 180.0, .elevation = 45.0});
  const PreethamSky sky(2.5, sun);
  EXPECT_NEAR(sky.colour({0, 1, 0}).luminance, preetham_zenith(2.5, 0.25 * pi).luminance, 1e-9);
  const AnalyticSky made = make_analytic_sky({.kind = SkyKind::preetham, .sun = sun, .turbidity = 2.5, .illuminance = {}}, {});
  const glm::vec3 zenith = radiance_from(made.map, {0, 1, 0}, Suns::shown);
  EXPECT_NEAR(lux_per_watt * luminance_of(zenith), 1000.0 * sky.colour({0, 1, 0}).luminance,
              0.01 * lux_per_watt * luminance_of(zenith));
  EXPECT_GT(zenith.b, 1.5F * zenith.r);
  EXPECT_GT(seen(made, glm::normalize(sun + Vec3(0.1, 0.0, 0.0))), 2.0 * seen(made, {0, 1, 0}));
  // A clear day has some 10 to 25 klx from the sky, and 60 to 90 from the sun on a horizontal plane.
  const double sky_lux = lux_per_watt * luminance_of(glm::vec3(horizontal_irradiance(made.map)));
  EXPECT_GT(sky_lux, 8'000.0);
  EXPECT_LT(sky_lux, 30'000.0);
}

TEST(AnalyticSkies, TheSunOutsideTheAirHasItsIlluminance) {
  // Without haze and nearly without air, T = 1 and m -> its least, 1: 133.8 klx outside the air (IES), and
  // clear air of one mass with its ozone takes about a tenth to a fifth.
  const double zenith = lux_per_watt * luminance_of(glm::vec3(sun_irradiance(1.0, 0.0)));
  EXPECT_GT(zenith, 105'000.0);
  EXPECT_LT(zenith, 125'000.0);
  // Lower and hazier suns are weaker and redder.
  const Rgb high = sun_irradiance(3.0, 30.0 * degree), low = sun_irradiance(3.0, 85.0 * degree);
  EXPECT_LT(luminance_of(glm::vec3(low)), 0.3 * luminance_of(glm::vec3(high)));
  EXPECT_GT(low.r / low.b, 2.0 * high.r / high.b);
  EXPECT_LT(sun_irradiance(6.0, 0.5).g, sun_irradiance(2.0, 0.5).g);
  EXPECT_EQ(sun_irradiance(3.0, 91.0 * degree), Rgb(0.0));
}

TEST(AnalyticSkies, TheGroundHasAFifthOfSkyAndSun) {
  const Direction sun = direction_of({.azimuth = 0.0, .elevation = 60.0});
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::clear, .sun = sun, .illuminance = {}}, {});
  const double lit = luminance_of(glm::vec3(horizontal_irradiance(sky.map))) +
                     std::sin(60.0 * degree) * luminance_of(glm::vec3(sky.sun->irradiance));
  EXPECT_NEAR(seen(sky, {0.2, -0.5, 0.4}), ground_reflectance / pi * lit, 1e-4 * lit);
}

TEST(AnalyticSkies, RotationTurnsTheSunWithItsSky) {
  const Direction east = direction_of({.azimuth = 90.0, .elevation = 30.0});
  const AnalyticSky sky = make_analytic_sky({.kind = SkyKind::preetham, .sun = east, .illuminance = {}}, {.rotation = 90.0});
  const Direction north = direction_of({.azimuth = 0.0, .elevation = 30.0});
  EXPECT_GT(glm::dot(sky.sun->towards, north), 1.0 - 1e-9);
  EXPECT_GT(seen(sky, north), 2.0 * seen(sky, east));
}

TEST(AnalyticSkies, AreTheSameToTheBitEveryTime) {
  const SkySettings settings{.kind = SkyKind::preetham, .sun = direction_of({200.0, 25.0}), .illuminance = {}};
  EXPECT_EQ(make_analytic_sky(settings, {}).map.hash, make_analytic_sky(settings, {}).map.hash);
}

} // namespace
} // namespace meninas::test
