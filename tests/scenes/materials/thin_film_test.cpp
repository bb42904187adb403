// Thin films: the limits in which there is no interference, and their means.
#include "scenes/materials/thin_film.h"

#include "scenes/materials/bsdf.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/refraction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

double schlick(double f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5); }

// A film of the base's own glass has one face, whatever its thickness.
TEST(ThinFilm, OfTheBasesOwnGlassIsNotSeen) {
  const double f0 = std::pow(0.5 / 2.5, 2);
  for (const double thickness : {100.0, 400.0, 1000.0}) {
    const Rgb r = film_reflectance({1.5, thickness}, Rgb(f0), 1.0);
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(r[band], f0, 1e-9) << thickness;
  }
}

// A thick one has two, without interference: R = R_12 + T^2 R_23 / (1 - R_12 R_23).
TEST(ThinFilm, ThatIsThickIsTheSumOfItsReflections) {
  const double film = 1.4, base = 2.2, base_f0 = std::pow((base - 1.0) / (base + 1.0), 2);
  const double r12 = std::pow((film - 1.0) / (film + 1.0), 2);
  const double r23 = std::pow((base - film) / (base + film), 2);
  const double expected = r12 + (1.0 - r12) * (1.0 - r12) * r23 / (1.0 - r12 * r23);
  const Rgb r = film_reflectance({film, 50'000.0}, Rgb(base_f0), 1.0);
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(r[band], expected, 1e-6);
}

// A quarter of a wave of green between air and glass of n^2 is a mirror's opposite: the two
// reflections cancel there (coated lenses are purple).
TEST(ThinFilm, OfAQuarterOfAWaveTakesGreenAway) {
  const double film = 1.3, base = film * film;
  const double base_f0 = std::pow((base - 1.0) / (base + 1.0), 2);
  const Rgb r = film_reflectance({film, 550.0 / (4.0 * film)}, Rgb(base_f0), 1.0);
  EXPECT_LT(r.g, 0.2 * base_f0);
  EXPECT_GT(r.r + r.b, 2.0 * r.g);
}

TEST(ThinFilm, ColoursComeAndGoWithTheThicknessWithinBounds) {
  double least = 1.0, most = 0.0;
  for (double thickness = 0.0; thickness < 1000.0; thickness += 20.0)
    for (const double base : {0.02, 0.5, 1.0}) {
      const Rgb mean = mean_of_film({1.3, thickness}, Rgb(base)).reflectance;
      for (int band = 0; band < 3; ++band) {
        EXPECT_GE(mean[band], 0.0);
        EXPECT_LE(mean[band], 1.0);
      }
      if (base == 0.5) {
        least = std::min(least, mean.g / largest(mean));
        most = std::max(most, mean.g / largest(mean));
      }
    }
  EXPECT_LT(least, 0.9) << "purple at some thickness";
  EXPECT_GT(most, 0.99) << "green or white at another";
}

TEST(ThinFilm, SchlicksMeanIsItsOwn) {
  const Rgb f0 = schlick_f0_of_mean(Rgb(0.3));
  double mean = 0.0;
  for (int k = 0; k < 10000; ++k) {
    const double c = (k + 0.5) / 10000.0;
    mean += 2.0 * c * schlick(f0.g, c) / 10000.0;
  }
  EXPECT_NEAR(mean, 0.3, 1e-6);
  EXPECT_EQ(schlick_f0_of_mean(Rgb(0.0)), Rgb(0.0));
}

// Against many midpoints in the cosine.
TEST(ThinFilm, MeansAreThoseOfManyAngles) {
  for (const double ior : {1.3, 1.8})
    for (const double thickness : {0.0, 100.0, 400.0, 800.0, 1200.0})
      for (const Rgb& base : {Rgb(0.04), Rgb(0.9, 0.6, 0.2)}) {
        const ThinFilm film{ior, thickness};
        constexpr int steps = 4000;
        Rgb mean(0.0);
        double most = 0.0;
        for (int k = 0; k < steps; ++k) {
          const double c = (k + 0.5) / steps;
          const Rgb at = film_reflectance(film, base, c);
          mean += 2.0 * c / steps * at;
          most += 2.0 * c / steps * largest(at);
        }
        const FilmMean quick = mean_of_film(film, base);
        // The accuracy that the header states. The largest channel has kinks, where two cross.
        EXPECT_NEAR(quick.largest, most, 4e-3) << ior << ' ' << thickness;
        for (int band = 0; band < 3; ++band)
          EXPECT_NEAR(quick.reflectance[band], mean[band], 2e-3) << ior << ' ' << thickness;
      }
}

// --- On materials

Material filmed(double metallic, double roughness, double share = 1.0) {
  Material material;
  material.base_color = Rgb(0.9, 0.6, 0.3);
  material.metallic = metallic;
  material.roughness = roughness;
  material.iridescence = share;
  material.film_ior = 1.4;
  material.film_thickness = 450.0;
  return material;
}

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

void expect_near(const Rgb& found, const Rgb& expected, double tolerance) {
  for (int band = 0; band < 3; ++band)
    EXPECT_NEAR(found[band], expected[band], tolerance);
}

TEST(ThinFilmOnMetal, ReflectsByTheAngleAndItsMeanIsPassOnes) {
  for (const double share : {0.5, 1.0}) {
    const Material material = filmed(1.0, 0.0, share);
    const Bsdf bsdf = bsdf_of(material);
    for (const double c : {1.0, 0.7, 0.3, 0.05})
      expect_near(ideal_reflection(bsdf, c),
                  glm::mix(material.base_color,
                           film_reflectance({1.4, 450.0}, material.base_color, c), share),
                  1e-12);
    EXPECT_TRUE(is_mirror(material));
    EXPECT_TRUE(has_lobes(material)) << "its image is no constant share";
    expect_near(mirror_reflectance(material), bsdf.metal, 1e-12);
  }
  Material black = filmed(1.0, 0.0);
  black.base_color = Rgb(0.0);
  EXPECT_TRUE(is_mirror(black)) << "the film reflects where the metal does not";
}

TEST(ThinFilmOnPaint, ReflectsByTheAngleAboveWhatItLeaves) {
  const Bsdf bsdf = bsdf_of(filmed(0.0, 0.0));
  const double f0 = std::pow(0.5 / 2.5, 2);
  for (const double c : {1.0, 0.7, 0.3, 0.05}) {
    const Rgb film = film_reflectance({1.4, 450.0}, Rgb(f0), c);
    expect_near(ideal_reflection(bsdf, c), film, 1e-12);
    EXPECT_NEAR(coat_albedo(bsdf, {std::sqrt(1.0 - c * c), 0.0, c}), largest(film), 1e-9);
  }
}

// T = 1 - R of a face, from either side at the angles that belong together.
TEST(ThinFilmOnGlass, ReflectsAsMuchFromInside) {
  Material solid = filmed(0.0, 0.0);
  solid.base_color = Rgb(1.0);
  solid.transmission = 1.0;
  solid.thickness = 0.1;
  const Bsdf outside = bsdf_of(solid), inside = from_behind(outside);
  for (const double c : {1.0, 0.6, 0.2}) {
    const double sine = std::sqrt(1.0 - c * c) / solid.ior;
    const GlassShares in = glass_shares(outside.pane, c),
                      out = glass_shares(inside.pane, std::sqrt(1.0 - sine * sine));
    expect_near(in.reflected + in.passed, Rgb(1.0), 1e-12);
    expect_near(in.reflected, out.reflected, 1e-9);
    expect_near(in.reflected, film_reflectance({1.4, 450.0}, Rgb(0.04), c), 1e-9);
  }
  expect_near(glass_shares(inside.pane, 0.3).reflected, Rgb(1.0), 0.0); // totally
}

TEST(ThinFilmOnGlass, APaneLosesNothing) {
  Material pane = filmed(0.0, 0.0, 0.7);
  pane.base_color = Rgb(1.0);
  pane.transmission = 1.0;
  for (const double c : {1.0, 0.6, 0.2}) {
    const GlassShares shares = glass_shares(bsdf_of(pane).pane, c);
    expect_near(shares.reflected + shares.passed, Rgb(1.0), 1e-12);
  }
}

} // namespace
} // namespace meninas::test
