// Thin films: the limits in which there is no interference, and their means.
#include "scenes/materials/thin_film.h"

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
      const Rgb mean = mean_film_reflectance({1.3, thickness}, Rgb(base));
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

} // namespace
} // namespace meninas::test
