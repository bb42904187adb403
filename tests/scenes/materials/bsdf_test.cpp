// Laws that every way to scatter light obeys:
// energy, reciprocity, and samples that follow their density.
#include "scenes/materials/bsdf.h"
#include "scenes/materials/microfacets.h"
#include "scenes/sampling.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Direction at_angle(double degrees, double azimuth = 0.4) {
  const double theta = degrees * pi / 180.0;
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

Material plastic(double roughness) {
  Material material;
  material.base_color = Rgb(1.0);
  material.roughness = roughness;
  return material;
}

Material metal(double roughness) {
  Material material = plastic(roughness);
  material.metallic = 1.0;
  return material;
}

/// Wider along an oblique axis than across it.
Material brushed(Material material, double strength) {
  material.anisotropy = strength;
  material.anisotropy_direction = {0.6, 0.8};
  return material;
}

Material pane(double roughness) {
  Material material = plastic(roughness);
  material.transmission = 0.7;
  return material;
}

Material mixture() {
  Material material = plastic(0.15);
  material.base_color = Rgb(0.9, 0.5, 0.2);
  material.metallic = 0.4;
  material.specular = 0.8;
  material.specular_color = Rgb(0.5, 1.0, 2.0);
  material.ior = 1.8;
  return material;
}

Material with_sheen(Material material, double roughness) {
  material.sheen_color = Rgb(1.0, 0.8, 0.3);
  material.sheen_roughness = roughness;
  return material;
}

Material with_film(Material material, double share = 1.0) {
  material.iridescence = share;
  material.film_ior = 1.35;
  material.film_thickness = 420.0;
  return material;
}

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

struct NamedMaterial {
  const char* name;
  Material material;
};
std::ostream& operator<<(std::ostream& out, const NamedMaterial& named) {
  return out << named.name;
}

class BsdfLaws : public testing::TestWithParam<NamedMaterial> {
protected:
  const Bsdf bsdf = bsdf_of(GetParam().material);
};

/// What is reflected and transmitted of light from one direction, by sampling:
/// the mean of the weights.
Rgb sampled_albedo(const Bsdf& bsdf, const Direction& out, bool ideal_too = true) {
  constexpr std::uint32_t points = 1 << 14;
  Rgb sum(0.0);
  for (std::uint32_t k = 0; k < points; ++k) {
    const auto u = sobol4(k, 7);
    const auto drawn = sample(bsdf, out, {u[0], u[1], u[2]});
    if (drawn && (ideal_too || drawn->lobe == Lobe::spread))
      sum += drawn->weight / double(points);
  }
  return sum;
}

/// Calls visit(direction, solid angle) for steps over the whole sphere, even in the azimuth
/// and in s with |z| = 1 - s^2, which makes them about as narrow at the pole as elsewhere.
template <typename Visit>
void over_sphere(int steps, Visit visit) {
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < 4 * steps; ++j) {
        const double s = (i + 0.5) / steps, phi = (j + 0.5) * pi / (2.0 * steps);
        const double z = 1.0 - s * s, r = std::sqrt(1.0 - z * z);
        visit(Direction(r * std::cos(phi), r * std::sin(phi), side * z),
              2.0 * s / steps * pi / (2.0 * steps));
      }
}

TEST_P(BsdfLaws, NoMoreLeavesThanArrives) {
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
    const Rgb albedo = sampled_albedo(bsdf, at_angle(degrees));
    // The coat's albedo is tabulated to 1e-3, and as many samples are good to that.
    for (int band = 0; band < 3; ++band)
      EXPECT_LE(albedo[band], 1.0 + 3e-3) << degrees;
  }
}

TEST_P(BsdfLaws, ReciprocityHolds) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    Direction out = random.direction(), in = random.direction();
    out.z = std::abs(out.z);
    const Rgb forth = evaluate(bsdf, out, in);
    // Light that passes through is looked at from the other side: turn both over.
    const Rgb back = in.z > 0.0 ? evaluate(bsdf, in, out) : evaluate(bsdf, -in, -out);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(forth[band], back[band], 1e-9 * forth[band]);
  }
}

TEST_P(BsdfLaws, WeightsAreTheFunctionOverTheDensity) {
  Random random(5);
  for (int k = 0; k < 500; ++k) {
    const Direction out = at_angle(random.between(0.0, 89.0));
    const auto drawn =
        sample(bsdf, out, {random.between(0, 1), random.between(0, 1), random.between(0, 1)});
    if (!drawn || drawn->lobe != Lobe::spread)
      continue;
    EXPECT_NEAR(glm::length(drawn->in), 1.0, 1e-9);
    EXPECT_NEAR(drawn->density, sample_density(bsdf, out, drawn->in), 1e-9 * drawn->density);
    const Rgb expected = evaluate(bsdf, out, drawn->in) * std::abs(drawn->in.z) / drawn->density;
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(drawn->weight[band], expected[band], 1e-9 * (1.0 + expected[band]));
  }
}

TEST_P(BsdfLaws, SamplesAddUpToTheIntegral) {
  // Two routes to the albedo: sampling, and even steps over all directions.
  // Lobes narrower than the steps need the former.
  if (bsdf.alpha > 0.0 && bsdf.alpha < 0.02)
    GTEST_SKIP() << "too narrow for the steps";
  for (const double degrees : {0.0, 45.0, 75.0}) {
    const Direction out = at_angle(degrees);
    Rgb integral(0.0);
    over_sphere(250, [&](const Direction& in, double solid_angle) {
      integral += evaluate(bsdf, out, in) * std::abs(in.z) * solid_angle;
    });
    const Rgb sampled = sampled_albedo(bsdf, out, false);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(sampled[band], integral[band], 5e-3) << degrees;
  }
}

TEST_P(BsdfLaws, SamplesFollowTheirDensity) {
  // Chi-square over cells of cosine and azimuth, against the density integrated over each.
  if (bsdf.alpha > 0.0 && bsdf.alpha < 0.02)
    GTEST_SKIP() << "too narrow for the steps";
  constexpr int rows = 12, columns = 8, samples = 40'000, fine = 240;
  const Direction out = at_angle(50.0);
  const auto cell_of = [](const Direction& w) {
    const double phi = std::atan2(w.y, w.x) / (2.0 * pi) + 0.5;
    const int row = std::min(rows - 1, static_cast<int>((w.z + 1.0) / 2.0 * rows));
    return static_cast<std::size_t>(row * columns +
                                    std::min(columns - 1, static_cast<int>(phi * columns)));
  };
  std::array<double, rows * columns> expected{}, found{};
  over_sphere(fine, [&](const Direction& in, double solid_angle) {
    expected[cell_of(in)] += samples * sample_density(bsdf, out, in) * solid_angle;
  });
  Random random(11);
  for (int k = 0; k < samples; ++k) {
    const auto drawn =
        sample(bsdf, out, {random.between(0, 1), random.between(0, 1), random.between(0, 1)});
    if (drawn && drawn->lobe == Lobe::spread)
      found[cell_of(drawn->in)] += 1.0;
  }
  double chi2 = 0.0, cells = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (expected[k] < 20.0) {
      EXPECT_LE(found[k], 20.0 + 5.0 * std::sqrt(20.0));
      continue;
    }
    chi2 += (found[k] - expected[k]) * (found[k] - expected[k]) / expected[k];
    ++cells;
  }
  // A chi-square of n cells has mean n and variance 2 n; the steps add a little.
  EXPECT_LT(chi2, cells + 5.0 * std::sqrt(2.0 * cells) + 5.0);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, BsdfLaws,
    testing::Values(NamedMaterial{"diffuse", plastic(1.0)}, NamedMaterial{"polished", plastic(0.0)},
                    NamedMaterial{"satin", plastic(0.1)},
                    NamedMaterial{"coarse coat", plastic(0.2)}, NamedMaterial{"mirror", metal(0.0)},
                    NamedMaterial{"brushed", metal(0.3)}, NamedMaterial{"rough metal", metal(1.0)},
                    NamedMaterial{"mixture", mixture()}, NamedMaterial{"pane", pane(0.0)},
                    NamedMaterial{"frosted", pane(0.5)}, NamedMaterial{"satin pane", pane(0.2)},
                    NamedMaterial{"velvet", with_sheen(plastic(1.0), 0.3)},
                    NamedMaterial{"waxed cloth", with_sheen(plastic(0.15), 0.6)},
                    NamedMaterial{"lame", with_sheen(metal(0.4), 1.0)},
                    NamedMaterial{"brushed along an axis", brushed(metal(0.4), 0.6)},
                    NamedMaterial{"brushed coat", brushed(plastic(0.2), 0.4)},
                    NamedMaterial{"brushed pane", brushed(pane(0.4), 0.7)},
                    NamedMaterial{"film on a mirror", with_film(metal(0.0))},
                    NamedMaterial{"film on rough metal", with_film(metal(0.4), 0.6)},
                    NamedMaterial{"film on paint", with_film(plastic(0.1))},
                    NamedMaterial{"film on a mixture", with_film(mixture(), 0.5)},
                    NamedMaterial{"film on a pane", with_film(pane(0.4))}),
    [](const auto& given) {
      std::string name = given.param.name;
      std::ranges::replace(name, ' ', '_');
      return name;
    });

TEST(Bsdf, WhiteUnderACoatLosesNothing) {
  for (const double roughness : {0.0, 0.1, 0.2})
    for (const double degrees : {0.0, 45.0, 80.0, 88.0})
      // Single scattering loses light in the coat alone, which is little of little.
      EXPECT_NEAR(sampled_albedo(bsdf_of(plastic(roughness)), at_angle(degrees)).g, 1.0, 3e-3)
          << roughness << ' ' << degrees;
}

// What the film reflects is coloured: its strongest channel and what gets below it add up to 1.
TEST(Bsdf, WhiteUnderAFilmLosesNothingOfItsStrongestChannel) {
  for (const double roughness : {0.0, 0.1, 0.2})
    for (const double degrees : {0.0, 45.0, 80.0})
      // The tables are good to 3e-3; the means of films to 4e-3 of what they reflect.
      EXPECT_NEAR(
          largest(sampled_albedo(bsdf_of(with_film(plastic(roughness))), at_angle(degrees))), 1.0,
          5e-3)
          << roughness << ' ' << degrees;
}

TEST(Bsdf, AWhiteMetalLosesNothing) {
  // Off the steps of the table, which is what limits it.
  for (const double roughness : {0.05, 0.3, 0.55, 0.777, 1.0})
    for (const double degrees : {0.0, 45.0, 80.0, 88.0})
      EXPECT_NEAR(sampled_albedo(bsdf_of(metal(roughness)), at_angle(degrees)).g, 1.0, 3e-3)
          << roughness << ' ' << degrees;
}

TEST(Bsdf, ASmoothMetalApproachesTheMirror) {
  EXPECT_NEAR(sampled_albedo(bsdf_of(metal(0.011)), at_angle(45)).g, 1.0, 1e-4);
  EXPECT_EQ(sampled_albedo(bsdf_of(metal(0.01)), at_angle(45)), Rgb(1.0));
}

TEST(Bsdf, ThePaneReflectsAndTransmitsByFresnel) {
  Material material = pane(0.0);
  material.transmission = 1.0;
  material.base_color = Rgb(0.5, 1.0, 1.0);
  const Bsdf bsdf = bsdf_of(material);
  const Direction out = at_angle(0.0);
  EXPECT_EQ(evaluate(bsdf, out, -out), Rgb(0.0));
  Rgb through(0.0), back(0.0);
  constexpr int samples = 1 << 12;
  for (std::uint32_t k = 0; k < samples; ++k) {
    const auto u = sobol4(k, 7);
    const auto drawn = sample(bsdf, out, {u[0], u[1], u[2]});
    ASSERT_TRUE(drawn);
    (drawn->lobe == Lobe::straight ? through : back) += drawn->weight / double(samples);
    EXPECT_EQ(drawn->in, drawn->lobe == Lobe::straight ? -out : Direction(-out.x, -out.y, out.z));
  }
  // Both faces, and what goes to and fro between them.
  const double tinted = 0.96 * 0.96 * 0.5 / (1.0 - 0.02 * 0.02);
  EXPECT_NEAR(back.r, 0.04 + 0.02 * tinted, 1e-3);
  EXPECT_NEAR(through.r, tinted, 1e-3);
  EXPECT_NEAR(through.g, 0.96 / 1.04, 1e-3);
}

TEST(Microfacets, NormalsFillTheProjectedHemisphere) {
  for (const double alpha : {0.05, 0.3, 1.0}) {
    double area = 0.0;
    over_sphere(400, [&](const Direction& h, double solid_angle) {
      area += facet_density(alpha, h) * std::max(0.0, h.z) * solid_angle;
    });
    EXPECT_NEAR(area, 1.0, 2e-3) << alpha;
  }
}

TEST(Microfacets, TheRoughestLobeInClosedForm) {
  // At alpha = 1 and normal incidence the lobe integrates
  // to integral_0^1 c / (1 + c) dc = 1 - ln 2.
  const SchlickAlbedo e = schlick_albedo(1.0, 1.0);
  EXPECT_NEAR(e.f0 + e.f90, 1.0 - std::log(2.0), 1e-3);
}

TEST(Microfacets, TheTabulatedMeanIsThatOfTheTable) {
  for (const double roughness : {0.0, 0.05, 0.2, 0.7}) {
    SchlickAlbedo mean;
    constexpr int steps = 20'000;
    for (int k = 0; k < steps; ++k) {
      const double c = (k + 0.5) / steps;
      const SchlickAlbedo e = schlick_albedo(roughness, c);
      mean.f0 += 2.0 * c * e.f0 / steps;
      mean.f90 += 2.0 * c * e.f90 / steps;
    }
    EXPECT_NEAR(mean_schlick_albedo(roughness).f0, mean.f0, 1e-4);
    EXPECT_NEAR(mean_schlick_albedo(roughness).f90, mean.f90, 1e-4);
  }
}

} // namespace
} // namespace meninas::test
