#include "scenes/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace meninas {
namespace {

struct Pair {
  std::size_t first;
  std::size_t second;
};

// The number of points in each of the 2^a x 2^b equal boxes of the unit square
std::vector<int> box_counts(Pair dims, std::uint32_t first, std::uint32_t count, int a, int b,
                            std::uint32_t seed) {
  std::vector<int> boxes(std::size_t{1} << (a + b));
  for (std::uint32_t n = first; n < first + count; ++n) {
    const auto p = sobol4(n, seed);
    const auto i = static_cast<std::size_t>(std::ldexp(p[dims.first], a));
    const auto j = static_cast<std::size_t>(std::ldexp(p[dims.second], b));
    ++boxes[(i << b) + j];
  }
  return boxes;
}

TEST(Sobol, PowerOfTwoPrefixesHaveOnePointInEveryElementaryInterval) {
  for (const std::uint32_t seed : {0U, 1U, 123456789U})
    for (const auto dims : {Pair{0, 1}, Pair{2, 3}})
      for (int m = 0; m <= 12; ++m)
        for (int a = 0; a <= m; ++a)
          for (const auto boxes = box_counts(dims, 0, 1U << m, a, m - a, seed);
               const auto count : boxes)
            ASSERT_EQ(count, 1) << "m = " << m << ", a = " << a;
}

TEST(Sobol, LaterBlocksAreStratifiedAsWell) {
  for (const auto dims : {Pair{0, 1}, Pair{2, 3}})
    for (int a = 0; a <= 8; ++a)
      for (const auto boxes = box_counts(dims, 37U << 8, 1U << 8, a, 8 - a, 5);
           const auto count : boxes)
        ASSERT_EQ(count, 1);
}

TEST(Sobol, CoordinatesAreInTheUnitIntervalWithTheRightMoments) {
  std::array<double, 4> sum{};
  std::array<double, 4> squares{};
  constexpr std::uint32_t count = 1U << 16;
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto p = sobol4(n, 99);
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_GE(p[k], 0.0F);
      ASSERT_LT(p[k], 1.0F);
      sum[k] += static_cast<double>(p[k]);
      squares[k] += static_cast<double>(p[k]) * static_cast<double>(p[k]);
    }
  }
  // One point in each of 65536 intervals: the error of a mean is at most half an interval
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(sum[k] / count, 0.5, 0.5 / count);
    EXPECT_NEAR(squares[k] / count, 1.0 / 3.0, 1.0 / count);
  }
}

TEST(Sobol, PairsAreThoseOfThePoint) {
  for (std::uint32_t k = 0; k < 300; ++k) {
    const auto point = sobol4(k, 17);
    EXPECT_EQ(sobol2(k, 17, SobolPair::first), glm::vec2(point[0], point[1]));
    EXPECT_EQ(sobol2(k, 17, SobolPair::second), glm::vec2(point[2], point[3]));
  }
}

TEST(Sobol, SeedsGiveUnrelatedPoints) {
  // The mean of the same index over seeds is 1/2 with deviation sqrt(1/12/n);
  // six deviations happen once in 5e8 tests.
  constexpr std::uint32_t count = 1U << 14;
  for (const std::uint32_t n : {0U, 1U, 1000U}) {
    std::array<double, 4> sum{};
    double product = 0.0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
      const auto p = sobol4(n, seed);
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] += static_cast<double>(p[k]);
      product +=
          (static_cast<double>(p[0]) - 0.5) * (static_cast<double>(sobol4(n, seed + 1)[0]) - 0.5);
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(sum[k] / count, 0.5, 6.0 * std::sqrt(1.0 / 12.0 / count));
    EXPECT_NEAR(product / count, 0.0, 6.0 / 12.0 / std::sqrt(count));
  }
}

// The largest error of the share of points in boxes [0, x) x [0, y)
double star_discrepancy(const std::vector<std::array<float, 4>>& points, Pair dims) {
  double worst = 0.0;
  for (int i = 1; i <= 32; ++i)
    for (int j = 1; j <= 32; ++j) {
      const auto x = static_cast<float>(i) / 32.0F - 0.011F;
      const auto y = static_cast<float>(j) / 32.0F - 0.007F;
      double inside = 0.0;
      for (const auto& p : points)
        inside += p[dims.first] < x && p[dims.second] < y ? 1.0 : 0.0;
      worst = std::max(worst, std::abs(inside / static_cast<double>(points.size()) -
                                       static_cast<double>(x * y)));
    }
  return worst;
}

TEST(Sobol, DiscrepancyOfEveryPairBeatsRandomPoints) {
  std::vector<std::array<float, 4>> points;
  std::vector<std::array<float, 4>> random;
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> uniform;
  for (std::uint32_t n = 0; n < 1024; ++n) {
    points.push_back(sobol4(n, 7));
    random.push_back(
        {uniform(generator), uniform(generator), uniform(generator), uniform(generator)});
  }
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b)
      EXPECT_LT(star_discrepancy(points, {a, b}), 0.5 * star_discrepancy(random, {a, b})) << a << b;
}

TEST(Hash, DependsOnEveryArgumentAndSpreads) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t a = 0; a < 20; ++a)
    for (std::uint32_t b = 0; b < 20; ++b)
      for (std::uint32_t c = 0; c < 20; ++c)
        seen.insert(hash(a, b, c));
  // 8000 of 2^32 values collide with probability 0.7 %, which the fixed arguments do not.
  EXPECT_EQ(seen.size(), 8000U);
}

TEST(CosineHemisphere, MeansAreThoseOfTheDensity) {
  constexpr std::uint32_t count = 1U << 16;
  Vec3 mean(0.0);
  double squared_height = 0.0;
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto p = sobol4(n, 11);
    const auto d = Vec3(cosine_hemisphere(p[0], p[1]));
    ASSERT_NEAR(glm::length(d), 1.0, 1e-6); // floats
    ASSERT_GT(d.z, 0.0);
    mean += d / static_cast<double>(count);
    squared_height += d.z * d.z / count;
  }
  // E[z] = 2/3, E[z^2] = 1/2; stratified points integrate them to about count^-1
  EXPECT_NEAR(mean.x, 0.0, 1e-4);
  EXPECT_NEAR(mean.y, 0.0, 1e-4);
  EXPECT_NEAR(mean.z, 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(squared_height, 0.5, 1e-4);
}

TEST(CosineHemisphere, CornersOfTheSquareStayAboveThePlane) {
  for (const float u : {0.0F, 0.5F, 0x1.fffffep-1F})
    for (const float v : {0.0F, 0.5F, 0x1.fffffep-1F}) {
      const auto d = cosine_hemisphere(u, v);
      EXPECT_GT(d.z, 0.0F);
      EXPECT_NEAR(glm::length(d), 1.0F, 1e-6F);
    }
}

TEST(ConcentricDisc, KeepsAreaFractions) {
  // The inner square of half the width, a quarter of the area,
  // becomes the inner disc of half the radius.
  constexpr std::uint32_t count = 1U << 14;
  int inside = 0;
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto p = sobol4(n, 2);
    const auto d = concentric_disc(p[0], p[1]);
    ASSERT_LE(glm::length(d), 1.0F + 1e-6F);
    if (glm::length(d) < 0.5F)
      ++inside;
  }
  // Stratified: only boxes along the circle may be off
  EXPECT_NEAR(inside / static_cast<double>(count), 0.25, 2e-3);
  EXPECT_EQ(concentric_disc(0.5F, 0.5F), glm::vec2(0.0F));
}

TEST(TangentFrame, IsOrthonormalAndRightHandedForAllDirections) {
  std::vector<Direction> normals{{0, 0, 1},
                                 {0, 0, -1},
                                 {1, 0, 0},
                                 {0, -1, 0},
                                 glm::normalize(Vec3(1e-9, 1e-9, -1)),
                                 glm::normalize(Vec3(1e-4, -1e-5, -1)),
                                 glm::normalize(Vec3(1, 1, -0.0))};
  for (std::uint32_t n = 0; n < 1000; ++n) {
    const auto p = sobol4(n, 4);
    const auto z = 2.0 * static_cast<double>(p[0]) - 1.0;
    const auto angle = 2.0 * std::numbers::pi * static_cast<double>(p[1]);
    const auto r = std::sqrt(1.0 - z * z);
    normals.push_back(glm::normalize(Vec3(r * std::cos(angle), r * std::sin(angle), z)));
  }
  for (const auto& normal : normals) {
    const auto [t, b] = tangent_frame(normal);
    // A few roundings of double
    EXPECT_NEAR(glm::length(t), 1.0, 1e-14);
    EXPECT_NEAR(glm::length(b), 1.0, 1e-14);
    EXPECT_NEAR(glm::dot(t, b), 0.0, 1e-14);
    EXPECT_NEAR(glm::distance(glm::cross(t, b), normal), 0.0, 1e-14);
  }
}

} // namespace
} // namespace meninas
