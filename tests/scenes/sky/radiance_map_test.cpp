// Maps of radiance: where texels are, what faulty ones become, rotation, and suns taken out.
#include "scenes/sky/radiance_map.h"
#include "tests/support/skies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
constexpr double pi = std::numbers::pi;

RadianceMap raw_map(int width, int height, const glm::vec3& texel) {
  RadianceMap raw;
  raw.name = "sky.hdr";
  raw.width = width;
  raw.height = height;
  raw.texels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), texel);
  return raw;
}

TEST(RadianceMaps, PlacesAndDirectionsAreInverse) {
  const RadianceMap map = map_of([](const Direction&) { return Rgb(1.0); }, 16, {.rotation = 37.0});
  for (const double u : {0.01, 0.3, 0.5, 0.77, 0.99})
    for (const double v : {0.02, 0.4, 0.5, 0.9}) {
      const Vec2 place = place_of(map, 3.0 * direction_at(map, u, v));
      EXPECT_NEAR(place.x, u, 1e-12);
      EXPECT_NEAR(place.y, v, 1e-12);
    }
}

TEST(RadianceMaps, PlusXIsInTheMiddleAndPlusZAQuarterToItsRight) {
  const RadianceMap map = raw_map(4, 2, glm::vec3(1.0F));
  const Direction middle = direction_at(map, 0.5, 0.5), right = direction_at(map, 0.75, 0.5);
  EXPECT_NEAR(glm::distance(middle, Direction(1, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(right, Direction(0, 0, 1)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(direction_at(map, 0.2, 0.0), Direction(0, 1, 0)), 0.0, 1e-12);
}

TEST(RadianceMaps, RotationTurnsTheSkyCounterClockwiseSeenFromAbove) {
  // What was in the east, +X, is a quarter further on in the north, -Z.
  const auto bright_in_the_east = [](const Direction& d) { return Rgb(std::max(0.0, d.x)); };
  const RadianceMap map = map_of(bright_in_the_east, 64, {.rotation = 90.0});
  EXPECT_NEAR(radiance_from(map, {0, 0, -1}, Suns::shown).g, 1.0, 0.01);
  EXPECT_NEAR(radiance_from(map, {0, 0, 1}, Suns::shown).g, 0.0, 0.01);
  EXPECT_NEAR(radiance_from(map, {1, 0, 0}, Suns::shown).g, 0.0, 0.06);
}

TEST(RadianceMaps, InterpolationIsOfSecondOrderAndWrapsAround) {
  const auto smooth = [](const Direction& d) { return Rgb(2.0 + d.x + 0.5 * d.y * d.z); };
  const RadianceMap map = map_of(smooth, 256);
  // Second derivatives are at most about 2, texels 2 pi / 256 wide: h^2 / 8 * 2 < 2e-4; near the poles rows end.
  for (double u = 0.003; u < 1.0; u += 0.0371)
    for (double v = 0.02; v < 0.98; v += 0.0317) {
      const Direction d = direction_at(map, u, v);
      EXPECT_NEAR(radiance_from(map, d, Suns::shown).r, smooth(d).r, 4e-4) << u << ' ' << v;
    }
}

TEST(RadianceMaps, SolidAnglesAddUpToTheSphere) {
  const RadianceMap map = raw_map(7, 5, glm::vec3(1.0F));
  double sum = 0.0;
  for (int j = 0; j < map.height; ++j)
    sum += map.width * texel_solid_angle(map, j);
  EXPECT_NEAR(sum, 4.0 * pi, 1e-12);
  EXPECT_NEAR(mean_radiance(map).g, 1.0, 1e-12);
}

TEST(RadianceMaps, WhatIsNoRadianceIsTakenForNoneAndSaid) {
  RadianceMap raw = raw_map(8, 4, glm::vec3(1.0F));
  raw.texels[3].g = std::numeric_limits<float>::quiet_NaN();
  raw.texels[5].r = -2.0F;
  raw.texels[6].b = -1.0F;
  TexelFaults faults;
  const RadianceMap map = make_radiance_map(raw, {}, faults);
  EXPECT_EQ(map.texels[3], glm::vec3(1.0F, 0.0F, 1.0F));
  EXPECT_EQ(map.texels[5], glm::vec3(0.0F, 1.0F, 1.0F));
  EXPECT_THAT(warnings_of(map, faults),
              ElementsAre("sky.hdr: 1 texel is not a number: taken for 0",
                          "sky.hdr: 2 texels are negative: taken for 0"));
  raw.texels[7].r = std::numeric_limits<float>::infinity();
  TexelFaults more;
  const RadianceMap bright = make_radiance_map(raw, {}, more);
  EXPECT_TRUE(std::isfinite(bright.texels[7].r));
  EXPECT_THAT(warnings_of(bright, more).back(), HasSubstr("infinite"));
  TexelFaults no_faults;
  EXPECT_THAT(warnings_of(map, (make_radiance_map(raw_map(4, 2, glm::vec3(1.0F)), {}, no_faults),
                                no_faults)),
              IsEmpty());
}

TEST(RadianceMaps, HugePicturesAreReducedToTheLimit) {
  RadianceMap raw = raw_map(8192, 4096, glm::vec3(1.0F));
  for (std::size_t k = 0; k < raw.texels.size(); k += 2)
    raw.texels[k] = glm::vec3(3.0F);
  TexelFaults faults;
  const RadianceMap map = make_radiance_map(std::move(raw), {}, faults);
  EXPECT_EQ(map.width, 4096);
  EXPECT_EQ(map.height, 2048);
  EXPECT_EQ(map.texels[12345], glm::vec3(2.0F));
  EXPECT_THAT(warnings_of(map, faults),
              ElementsAre("sky.hdr: reduced to 4096 x 2048 texels, 2 along each axis to one"));
}

/// A grey sky with a sun of that many degrees about a direction.
RadianceMap with_sun(const Direction& towards, double radius, double radiance, int width = 1024) {
  const double cosine = std::cos(radius / 180.0 * pi);
  return map_of(
      [&](const Direction& d) { return Rgb(glm::dot(d, towards) > cosine ? radiance : 1.0); },
      width);
}

TEST(RadianceMaps, SmallSunsBecomeDirectionalLightAsMuchAsTheMapLoses) {
  const Direction towards = glm::normalize(Vec3(0.3, 0.8, -0.5));
  const RadianceMap map = with_sun(towards, 1.0, 1e5);
  ASSERT_EQ(map.suns.size(), 1U);
  EXPECT_GT(glm::dot(map.suns[0].towards, towards), std::cos(0.1 / 180.0 * pi));
  // The disc of a degree has 2 pi (1 - cos 1 degree) sr; texels of 0.35 degrees do not tell it better than to a tenth.
  EXPECT_NEAR(map.suns[0].irradiance.g, 1e5 * 2.0 * pi * (1.0 - std::cos(pi / 180.0)),
              0.1 * map.suns[0].irradiance.g);
  RadianceMap rest = map;
  rest.texels = map.without_suns;
  const double lost = 4.0 * pi * (mean_radiance(map).g - mean_radiance(rest).g);
  EXPECT_NEAR(map.suns[0].irradiance.g, lost, 1e-5 * lost);
  EXPECT_GT(radiance_from(map, towards, Suns::shown).g, 9e4F);
  EXPECT_LT(radiance_from(map, towards, Suns::left_out).g, 1e3F);
}

TEST(RadianceMaps, LargeOrFaintLightsStayInTheMap) {
  const Direction up{0.0, 1.0, 0.0}, aside = glm::normalize(Vec3(1.0, 0.2, 0.0));
  EXPECT_TRUE(with_sun(aside, 10.0, 1e5).suns.empty()) << "wide";
  EXPECT_TRUE(with_sun(aside, 1.0, 20.0).suns.empty()) << "faint";
  EXPECT_TRUE(with_sun(up, 1.0, 1.0).suns.empty()) << "no sun";
  EXPECT_EQ(with_sun(up, 1.0, 1e5).suns.size(), 1U) << "about the pole";
  EXPECT_EQ(with_sun({-1.0, 0.0, 0.0}, 1.0, 1e5).suns.size(), 1U) << "across the seam";
}

TEST(RadianceMaps, ASunMayBeAllTheLightThereIs) {
  RadianceMap raw = raw_map(2048, 1024, glm::vec3(0.0F));
  raw.texels[7] = glm::vec3(1e6F); // about the pole
  TexelFaults faults;
  const RadianceMap map = make_radiance_map(std::move(raw), {}, faults);
  ASSERT_EQ(map.suns.size(), 1U);
  const double all = 1e6 * texel_solid_angle(map, 0);
  EXPECT_NEAR(map.suns[0].irradiance.g, all, 1e-5 * all);
  EXPECT_GT(map.suns[0].towards.y, 0.9999);
}

TEST(RadianceMaps, TexelsWiderThanASunAreNone) {
  RadianceMap raw = raw_map(64, 32, glm::vec3(1.0F));
  raw.texels[64 * 12 + 5] = glm::vec3(1e6F);
  TexelFaults faults;
  EXPECT_TRUE(make_radiance_map(std::move(raw), {}, faults).suns.empty());
}

TEST(Environments, SayWhatTheyAre) {
  EXPECT_TRUE(is_dark(Environment{}));
  EXPECT_FALSE(is_dark(Environment(Rgb(0.0, 0.1, 0.0))));
  EXPECT_TRUE(is_grey(Environment(Rgb(2.0))));
  EXPECT_FALSE(is_grey(sky_of([](const Direction&) { return Rgb(1.0, 2.0, 1.0); }, 4)));
  EXPECT_EQ(radiance_from(Environment(Rgb(2.0)), {0, 1, 0}), Rgb(2.0));
  const Environment a = sky_of([](const Direction&) { return Rgb(1.0); }, 4);
  const Environment b = sky_of([](const Direction&) { return Rgb(1.0); }, 4, {.rotation = 10.0});
  EXPECT_NE(content_hash(a), content_hash(b));
  EXPECT_NE(content_hash(a), content_hash(Environment(Rgb(1.0))));
}

} // namespace
} // namespace meninas::test
