// Sheets (KHR_materials_diffuse_transmission): what is not reflected below the coat comes out behind.
#include "scenes/materials/bsdf.h"
#include "scenes/materials/lobes.h"
#include "scenes/sampling.h"
#include "tests/support/translucent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

Direction at_cosine(double cosine) { return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}; }

/// What comes back and what comes out behind, by the samples' weights.
struct Albedos {
  Rgb reflected{0.0}, passed{0.0};
};
Albedos sampled_albedos(const Bsdf& bsdf, double cosine) {
  constexpr std::uint32_t samples = 1 << 16;
  Albedos sum;
  for (std::uint32_t k = 0; k < samples; ++k) {
    const auto u = sobol4(k, 0xc107);
    if (const auto drawn = sample(bsdf, at_cosine(cosine), {u[0], u[1], u[2]}))
      (drawn->in.z > 0.0 ? sum.reflected : sum.passed) += drawn->weight / double(samples);
  }
  return sum;
}

TEST(Translucency, ReflectAndPassTheirSharesEvenly) {
  const Bsdf bsdf = bsdf_of(translucent({0.8, 0.5, 0.2}, 0.25, {1.0, 0.4, 0.6}));
  for (int band = 0; band < 3; ++band) {
    const double rho = 0.75 * Rgb(0.8, 0.5, 0.2)[band], tau = 0.25 * Rgb(1.0, 0.4, 0.6)[band];
    for (const double z : {0.1, 0.9}) {
      EXPECT_NEAR(evaluate(bsdf, at_cosine(0.6), at_cosine(z))[band], rho / std::numbers::pi,
                  1e-12);
      const Direction behind(-at_cosine(z));
      EXPECT_NEAR(evaluate(bsdf, at_cosine(0.6), behind)[band], tau / std::numbers::pi, 1e-12);
    }
    EXPECT_NEAR(even_reflectance(bsdf, at_cosine(0.3))[band], rho, 1e-12);
    EXPECT_NEAR(even_transmittance(bsdf, at_cosine(0.3))[band], tau, 1e-12);
  }
}

TEST(Translucency, MetalPassesNothing) {
  Material material = translucent(Rgb(0.5), 0.5, Rgb(1.0));
  material.metallic = 0.5;
  EXPECT_NEAR(bsdf_of(material).passed.g, 0.25, 1e-12);
  EXPECT_TRUE(is_translucent(material));
  material.metallic = 1.0;
  EXPECT_EQ(bsdf_of(material).passed, Rgb(0.0));
  EXPECT_FALSE(is_translucent(material));
  EXPECT_FALSE(is_translucent(translucent(Rgb(0.5), 0.5, Rgb(0.0)))) << "of no colour";
}

// 65536 low-discrepancy samples of a lobe: 2e-3 of a white surface.
TEST(Translucency, WhiteOnesScatterAllLightWhateverIsAboveThem) {
  Material plain = translucent(Rgb(1.0), 0.7, Rgb(1.0)), coated = plain, fibres = plain,
           half = plain;
  coated.roughness = 0.15;
  fibres.sheen_color = Rgb(1.0);
  fibres.sheen_roughness = 0.5;
  half.alpha_mode = AlphaMode::blend;
  half.alpha = 0.5;
  half.transmission = 0.5;
  for (const Material& material : {plain, coated, fibres, half})
    for (const double cosine : {0.15, 0.5, 0.95}) {
      const Albedos albedos = sampled_albedos(bsdf_of(material), cosine);
      for (int band = 0; band < 3; ++band)
        EXPECT_NEAR(albedos.reflected[band] + albedos.passed[band], 1.0, 2e-3) << cosine;
      EXPECT_GT(albedos.passed.g, 0.3);
    }
}

TEST(Translucency, WhatTheyPassIsTheSameBothWays) {
  Material coated = translucent(Rgb(0.9), 0.5, Rgb(0.8));
  coated.roughness = 0.1;
  coated.sheen_color = Rgb(0.5);
  coated.sheen_roughness = 0.6;
  const Bsdf bsdf = bsdf_of(coated);
  for (const double a : {0.1, 0.5, 0.9})
    for (const double b : {0.2, 0.7}) {
      const Rgb there = evaluate(bsdf, at_cosine(a), -at_cosine(b)),
                back = evaluate(bsdf, at_cosine(b), -at_cosine(a));
      EXPECT_GT(there.g, 0.0);
      EXPECT_NEAR(there.g, back.g, 1e-12);
    }
}

TEST(Translucency, MeansAreThoseOfTheAngles) {
  Material coated = translucent(Rgb(0.9), 0.5, Rgb(0.8));
  coated.roughness = 0.1;
  const Bsdf bsdf = bsdf_of(coated);
  constexpr int steps = 2000;
  Rgb mean(0.0);
  for (int k = 0; k < steps; ++k) {
    const double cosine = (k + 0.5) / steps;
    mean += 2.0 * cosine * even_transmittance(bsdf, at_cosine(cosine)) / double(steps);
  }
  // The table of albedos and that of their means are apart by 1e-3.
  EXPECT_NEAR(diffuse_transmittance(coated, untextured(coated)).g, mean.g, 1e-3);
}

TEST(Translucency, DensitiesAreThoseOfTheSamples) {
  Material coated = translucent(Rgb(0.3), 0.6, Rgb(0.8, 0.2, 0.5));
  coated.roughness = 0.2;
  const Bsdf bsdf = bsdf_of(coated);
  // The integral of the density over both half spheres is the chance that a sample is drawn.
  constexpr std::uint32_t samples = 1 << 16;
  double integral = 0.0, drawn = 0.0;
  const Direction out = at_cosine(0.7);
  for (std::uint32_t k = 0; k < samples; ++k) {
    const auto u = sobol4(k, 0xde45);
    const double z = 2.0 * double{u[0]} - 1.0, r = std::sqrt(1.0 - z * z),
                 phi = 2.0 * std::numbers::pi * double{u[1]};
    integral += 4.0 * std::numbers::pi *
                sample_density(bsdf, out, {r * std::cos(phi), r * std::sin(phi), z}) / samples;
    drawn += sample(bsdf, out, {u[0], u[1], u[2]}) ? 1.0 / samples : 0.0;
  }
  EXPECT_NEAR(integral, drawn, 0.01); // a lobe of width 0.04 by even directions
}

} // namespace
} // namespace meninas::test
