// Sheen: its share by the angle, and that white cloth stays white.
#include "scenes/materials/bsdf.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/sheen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Material white_cloth(double sheen_roughness, double sheen = 1.0) {
  Material material;
  material.base_color = Rgb(1.0);
  material.sheen_color = Rgb(sheen);
  material.sheen_roughness = sheen_roughness;
  return material;
}

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

/// Lambda of Conty and Kulla for a = 1: for the hemispherical fibres of roughness 1.
double lambda_of_rough(double cosine) {
  const auto l = [](double x) {
    return 21.5473 / (1.0 + 3.82987 * std::pow(x, 0.19823)) - 1.97760 * x - 4.32054;
  };
  return std::exp(cosine < 0.5 ? l(cosine) : 2.0 * l(0.5) - l(1.0 - cosine));
}

// Another route, by other steps: uniform random-free steps over theta and phi of the half vector's
// formula for a = 1, where D = 3 sin(theta_h) / (2 pi).
double albedo_of_rough(double cos_out) {
  constexpr int steps = 400;
  const double sin_out = std::sqrt(1.0 - cos_out * cos_out);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double theta = 0.5 * pi * (i + 0.5) / steps, phi = 2.0 * pi * (j + 0.5) / steps;
      const Vec3 o(sin_out, 0.0, cos_out);
      const Vec3 in(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const Vec3 h = glm::normalize(o + in);
      const double d = 3.0 * std::sqrt(std::max(0.0, 1.0 - h.z * h.z)) / (2.0 * pi);
      const double f = d / (4.0 * cos_out * in.z *
                            (1.0 + lambda_of_rough(cos_out) + lambda_of_rough(in.z)));
      sum += f * in.z * std::sin(theta) * (0.5 * pi / steps) * (2.0 * pi / steps);
    }
  return sum;
}

TEST(Sheen, TheTableIsTheIntegralOfTheLobe) {
  for (const double cosine : {1.0, 0.83, 0.5, 0.31, 0.12})
    EXPECT_NEAR(sheen_albedo(1.0, cosine), albedo_of_rough(cosine), 5e-3) << cosine;
}

TEST(Sheen, ShinesAlongTheSurface) {
  for (const double roughness : {0.2, 0.5, 0.8}) {
    EXPECT_GT(sheen_albedo(roughness, 0.1), 2.0 * sheen_albedo(roughness, 0.9)) << roughness;
    for (int k = 0; k <= 100; ++k) {
      EXPECT_GE(sheen_albedo(roughness, 0.01 * k), 0.0);
      EXPECT_LE(sheen_albedo(roughness, 0.01 * k), 1.0);
    }
  }
}

TEST(Sheen, ItsMeanIsThatOfTheTable) {
  for (const double roughness : {0.0, 0.25, 0.77, 1.0}) {
    constexpr int steps = 20000;
    double mean = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double c = (k + 0.5) / steps;
      mean += 2.0 * c * sheen_albedo(roughness, c) / steps;
    }
    EXPECT_NEAR(mean_sheen_albedo(roughness), mean, 1e-6);
  }
}

// What a furnace would show: exactly white, from everywhere.
TEST(Sheen, WhiteOnWhiteLosesNothing) {
  for (const double roughness : {0.1, 0.4, 1.0}) {
    const Bsdf bsdf = bsdf_of(white_cloth(roughness));
    for (const double cosine : {1.0, 0.6, 0.2, 0.02}) {
      const Direction out(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
      EXPECT_NEAR(even_reflectance(bsdf, out).g, 1.0, 1e-12);
      // and the integral of f over all directions is that.
      constexpr int steps = 4000;
      double integral = 0.0;
      for (int k = 0; k < steps; ++k) {
        const double c = (k + 0.5) / steps;
        const Direction in(0.0, std::sqrt(1.0 - c * c), c); // f is the same for all azimuths
        integral += 2.0 * pi * c * evaluate(bsdf, out, in).g / steps;
      }
      EXPECT_NEAR(integral, 1.0, 1e-5);
    }
    EXPECT_NEAR(mean_reflectance(bsdf).g, 1.0, 1e-12);
  }
}

TEST(Sheen, AddsItsColourInTheMean) {
  Material material = white_cloth(0.5);
  material.base_color = Rgb(0.0);
  material.sheen_color = Rgb(0.8, 0.4, 0.0);
  const Rgb mean = diffuse_reflectance(material);
  EXPECT_NEAR(mean.r, 0.8 * mean_sheen_albedo(0.5), 1e-12);
  EXPECT_NEAR(mean.g, 0.4 * mean_sheen_albedo(0.5), 1e-12);
  EXPECT_EQ(mean.b, 0.0);
  EXPECT_TRUE(has_lobes(material)) << "it differs by the angle";
  material.sheen_color = Rgb(0.0);
  EXPECT_FALSE(has_lobes(material));
}

// Of a white mirror the fibres leave 1 - E_avg, so that the two reflect 1 together: without that light between two
// such mirrors would grow without end.
TEST(Sheen, SmoothMetalBelowItReflectsNoMoreThanArrives) {
  for (const double roughness : {0.2, 0.6, 1.0}) {
    Material metal = white_cloth(roughness);
    metal.metallic = 1.0;
    metal.roughness = 0.0;
    ASSERT_TRUE(is_mirror(metal));
    const Rgb mirror = mirror_reflectance(metal), even = diffuse_reflectance(metal);
    EXPECT_NEAR(even.g, mean_sheen_albedo(roughness), 1e-12);
    EXPECT_NEAR(mirror.g + even.g, 1.0, 1e-12) << roughness;
    metal.sheen_color = Rgb(0.5, 0.25, 0.0);
    EXPECT_NEAR(mirror_reflectance(metal).b, 1.0 - 0.5 * mean_sheen_albedo(roughness), 1e-12)
        << "by the largest channel, as glTF says";
    metal.iridescence = 1.0;
    metal.film_ior = 1.3;
    const double with_film = mirror_reflectance(metal).g;
    metal.sheen_color = Rgb(0.0);
    EXPECT_NEAR(with_film, mirror_reflectance(metal).g * (1.0 - 0.5 * mean_sheen_albedo(roughness)), 1e-12);
  }
}

} // namespace
} // namespace meninas::test
