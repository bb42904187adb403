// Which pixels are drawn again:
// as many as wanted, each at most once, where the picture has edges; and sums stay what they are.
#include "raytrace/error/noise_choice.h"
#include "scenes/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meninas::test {
namespace {

/// Even in [0, 1), of a number and its seed.
double even(std::size_t k, std::uint32_t seed) {
  return double(hash(static_cast<std::uint32_t>(k), seed)) * 0x1p-32;
}

/// Contrasts as pictures have them: most next to none, a few a thousand times the others.
std::vector<double> peaked_contrasts(std::size_t count) {
  std::vector<double> contrasts(count);
  for (std::size_t k = 0; k < count; ++k)
    contrasts[k] = std::pow(even(k, 7), 12.0);
  return contrasts;
}

Image constant(int width, int height, float value) {
  Image picture(width, height);
  std::ranges::fill(picture.pixels, glm::vec3(value));
  return picture;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// A bright disc on a dark wall, a pixel's share of it being what is bright,
/// and what another draw changes of it: at the rim alone.
struct Disc {
  static constexpr int size = 64;
  Image picture{size, size};
  std::vector<std::uint8_t> emits = std::vector<std::uint8_t>(size * size, 0);
  std::vector<double> squares = std::vector<double>(size * size, 0.0); ///< of the change
  std::vector<glm::ivec2> pixels;

  Disc() {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const double inside = 6.3 - glm::distance(glm::dvec2(x, y), glm::dvec2(40.2, 21.7));
        const double share = std::clamp(inside + 0.5, 0.0, 1.0);
        picture.at(x, y) = glm::vec3(static_cast<float>(0.1 + 5.0 * share));
        const std::size_t p = place({x, y});
        squares[p] = share * (1.0 - share) * (0.5 + even(p, 3));
        pixels.emplace_back(x, y);
      }
  }

  static std::size_t place(glm::ivec2 pixel) {
    return static_cast<std::size_t>(pixel.y * size + pixel.x);
  }
  double mean() const { return sum_of(squares) / double(squares.size()); }

  struct Found {
    double mean, sigma; ///< of one choice
  };
  /// Over many choices.
  Found found(const std::vector<double>& contrasts, std::size_t wanted) const {
    constexpr std::uint32_t draws = 1024;
    double sum = 0.0, sum2 = 0.0;
    for (std::uint32_t seed = 0; seed < draws; ++seed) {
      const ProbeChoice choice = choose_redrawn(pixels, contrasts, size, wanted, hash(seed, 11));
      double value = 0.0;
      for (std::size_t k = 0; k < choice.pixels.size(); ++k)
        value += choice.weight[k] * squares[place(choice.pixels[k])] / double(choice.pixels.size());
      sum += value / draws;
      sum2 += value * value / draws;
    }
    return {sum, std::sqrt(std::max(sum2 - sum * sum, 0.0))};
  }
};

TEST(NoiseChoice, ChancesAreThoseOfSoManyPixels) {
  constexpr std::size_t count = 1000;
  const std::vector<double> contrasts = peaked_contrasts(count);
  for (const std::size_t wanted : {1, 20, 300, 700, 999}) {
    const std::vector<double> chances = chances_by(contrasts, wanted);
    ASSERT_EQ(chances.size(), count);
    EXPECT_NEAR(sum_of(chances), double(wanted), 1e-9 * double(wanted));
    for (const double chance : chances) {
      EXPECT_GE(chance, (1.0 - 1e-12) * double(wanted) / (2.0 * count));
      EXPECT_LE(chance, 1.0);
    }
  }
  EXPECT_GT(std::ranges::count(chances_by(contrasts, 300), 1.0), 10) << "or else none is certain";
}

TEST(NoiseChoice, ChancesAreHalfEvenHalfByContrast) {
  // None is certain:
  // 4 of 8 with a contrast of 1 beside 0 have (1/8 + 1/4) / 2 of the chances of two.
  const std::vector<double> chances = chances_by(std::vector<double>{0, 1, 0, 1, 1, 0, 1, 0}, 2);
  for (const std::size_t k : {1U, 3U, 4U, 6U})
    EXPECT_NEAR(chances[k], 0.375, 1e-12);
  for (const std::size_t k : {0U, 2U, 5U, 7U})
    EXPECT_NEAR(chances[k], 0.125, 1e-12);
  // One has all the contrast and would be drawn 4 (1/8 + 1) / 2 = 2.25 times:
  // it is certain, and the seven others share three.
  const std::vector<double> one = chances_by(std::vector<double>{0, 0, 0, 9, 0, 0, 0, 0}, 4);
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_NEAR(one[k], k == 3 ? 1.0 : 3.0 / 7.0, 1e-12);
}

TEST(NoiseChoice, DrawsSoManyAndNoneTwice) {
  const std::vector<double> contrasts = peaked_contrasts(1000);
  for (const std::size_t wanted : {1, 20, 300, 700, 999}) {
    const std::vector<double> chances = chances_by(contrasts, wanted);
    for (std::uint32_t seed = 0; seed < 64; ++seed) {
      const std::vector<std::size_t> drawn = drawn_by(chances, seed);
      EXPECT_EQ(drawn.size(), wanted);
      EXPECT_EQ(std::ranges::adjacent_find(drawn, std::greater_equal{}), drawn.end());
      for (std::size_t k = 0; k < chances.size(); ++k) {
        const bool there = std::ranges::binary_search(drawn, k);
        EXPECT_TRUE(there || chances[k] < 1.0) << k;
      }
    }
  }
}

TEST(NoiseChoice, DrawsEachWithItsChance) {
  constexpr std::uint32_t draws = 1 << 14;
  const std::vector<double> chances = chances_by(peaked_contrasts(60), 20);
  std::vector<double> counts(chances.size(), 0.0);
  for (std::uint32_t seed = 0; seed < draws; ++seed)
    for (const std::size_t k : drawn_by(chances, hash(seed, 5)))
      counts[k] += 1.0;
  for (std::size_t k = 0; k < chances.size(); ++k) {
    const double sigma = std::sqrt(draws * chances[k] * (1.0 - chances[k]));
    EXPECT_NEAR(counts[k], draws * chances[k], 4.0 * sigma) << k;
  }
}

TEST(NoiseChoice, DrawsAreSpreadOverTheList) {
  // Up to any place as many as the chances there sum to, rounded up or down;
  // other seeds draw others.
  const std::vector<double> chances = chances_by(peaked_contrasts(500), 100);
  for (std::uint32_t seed = 0; seed < 64; ++seed) {
    const std::vector<std::size_t> drawn = drawn_by(chances, seed);
    double sum = 0.0;
    for (std::size_t k = 0; k < chances.size(); ++k) {
      sum += chances[k];
      const auto so_far = std::ranges::upper_bound(drawn, k) - drawn.begin();
      EXPECT_LT(std::abs(double(so_far) - sum), 1.0 + 1e-9) << k;
    }
    EXPECT_NE(drawn, drawn_by(chances, seed + 1));
  }
}

TEST(NoiseChoice, KeepsMeans) {
  const Disc disc;
  const std::vector<double> contrasts = squared_contrasts(disc.picture, disc.emits);
  for (const std::size_t wanted : {16, 64, 512}) {
    const Disc::Found found = disc.found(contrasts, wanted);
    EXPECT_NEAR(found.mean, disc.mean(), 4.0 * found.sigma / 32.0) << wanted;
    EXPECT_LT(found.sigma / 32.0, 0.05 * disc.mean()) << "or else nothing is tested";
  }
  // Also where contrasts tell nothing of what is looked for, or wrongly:
  // drawn alike, one of sixty-four has twice the variance at most.
  std::vector<double> wrong(disc.squares.size());
  for (std::size_t p = 0; p < wrong.size(); ++p)
    wrong[p] = disc.squares[p] > 0.0 ? 0.0 : even(p, 19);
  const Disc::Found found = disc.found(wrong, 64);
  EXPECT_NEAR(found.mean, disc.mean(), 4.0 * found.sigma / 32.0);
}

TEST(NoiseChoice, IsNearlyCertainWhereTheNoiseIsAtAnEdge) {
  // Some fifty pixels of 4096 have all of the noise;
  // one in sixty-four drawn alike is less than one of them.
  const Disc disc;
  const std::vector<double> none(disc.squares.size(), 0.0);
  const double alike = disc.found(none, 64).sigma;
  EXPECT_GT(alike, 0.8 * disc.mean());
  EXPECT_LT(disc.found(squared_contrasts(disc.picture, disc.emits), 64).sigma, 0.3 * alike);
  EXPECT_LT(disc.found(squared_contrasts(disc.picture, disc.emits), 256).sigma, 0.1 * disc.mean());
}

TEST(NoiseChoice, ContrastIsThatOfNeighboursOutsideEmitters) {
  Image picture(4, 3);
  picture.at(1, 1) = glm::vec3(1.0F, 2.0F, 2.0F);
  std::vector<std::uint8_t> emits(12, 0);
  EXPECT_EQ(squared_contrasts(picture, emits),
            (std::vector<double>{9, 9, 9, 0, 9, 72, 9, 0, 9, 9, 9, 0}));
  // A lamp at (1, 1): nothing differs from it. One at (0, 1): one pair less.
  emits[5] = 1;
  EXPECT_EQ(squared_contrasts(picture, emits), std::vector<double>(12, 0.0));
  emits[5] = 0;
  emits[4] = 1;
  EXPECT_EQ(squared_contrasts(picture, emits),
            (std::vector<double>{9, 9, 9, 0, 0, 63, 9, 0, 9, 9, 9, 0}));
}

TEST(NoiseChoice, IsEvenWhereNothingDiffers) {
  for (const float value : {0.0F, 0.7F}) {
    const Image picture = constant(20, 10, value);
    std::vector<glm::ivec2> pixels;
    for (int k = 0; k < 200; ++k)
      pixels.emplace_back(k % 20, k / 20);
    const std::vector<double> contrasts =
        squared_contrasts(picture, std::vector<std::uint8_t>(200, 0));
    const ProbeChoice choice = choose_redrawn(pixels, contrasts, 20, 30, 1);
    ASSERT_EQ(choice.pixels.size(), 30U);
    for (const double weight : choice.weight)
      EXPECT_NEAR(weight, 1.0, 1e-9);
  }
}

TEST(NoiseChoice, TakesAllWhereFewAreThere) {
  const Image one = constant(1, 1, 0.5F);
  const std::vector<glm::ivec2> pixel{{0, 0}};
  const std::vector<double> none = squared_contrasts(one, std::vector<std::uint8_t>(1, 0));
  EXPECT_EQ(none, std::vector<double>(1, 0.0));
  for (const std::size_t wanted : {1, 2, 1000}) {
    const ProbeChoice choice = choose_redrawn(pixel, none, 1, wanted, 1);
    EXPECT_EQ(choice.pixels, pixel);
    EXPECT_EQ(choice.weight, std::vector<double>(1, 1.0));
  }
  EXPECT_TRUE(choose_redrawn(pixel, none, 1, 0, 1).pixels.empty());
  const Disc disc;
  const ProbeChoice all =
      choose_redrawn(disc.pixels, squared_contrasts(disc.picture, disc.emits), Disc::size, 5000, 1);
  EXPECT_EQ(all.pixels, disc.pixels);
  EXPECT_EQ(all.weight, std::vector<double>(disc.pixels.size(), 1.0));
  // Where everything is an emitter no pixel is left to choose from.
  const std::vector<std::uint8_t> emits(disc.pixels.size(), 1);
  EXPECT_EQ(sum_of(squared_contrasts(disc.picture, emits)), 0.0);
  EXPECT_TRUE(
      choose_redrawn({}, squared_contrasts(disc.picture, emits), Disc::size, 64, 1).pixels.empty());
}

} // namespace
} // namespace meninas::test
