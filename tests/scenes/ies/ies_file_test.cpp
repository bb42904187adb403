// IES files: editions, photometries, symmetries, and what is said of bad ones.
#include "scenes/ies/ies_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace meninas::test {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

Direction towards(double vertical, double horizontal) {
  const double g = vertical * pi / 180.0, f = horizontal * pi / 180.0;
  return {std::sin(g) * std::cos(f), std::sin(g) * std::sin(f), -std::cos(g)};
}

/// A file of type C that is the same all around: candela by vertical angles.
std::string round_file(const std::string& head, const std::string& angles, const std::string& candela,
                       int count) {
  return head + "TILT=NONE\n1 -1 1 " + std::to_string(count) + " 1 1 2 0 0 0\n1 1 50\n" + angles +
         "\n0\n" + candela + "\n";
}

std::string problem_of(const std::string& text, std::size_t* line = nullptr) {
  try {
    parse_ies(text);
  } catch (const IesProblem& problem) {
    if (line != nullptr)
      *line = problem.line;
    return problem.what();
  }
  return "none";
}

const std::string head_2002 = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody, 12 lamps\n";

TEST(IesFile, EveryEditionIsRead) {
  const std::string candela = "100 50 0";
  for (const std::string head :
       {"A label of 1986\nand another one\n", "IESNA91\n[TEST] 1\n", "IESNA:LM-63-1995\r\n[TEST]\r\n",
        "IESNA:LM-63-2002\n", "IES:LM-63-2019\n", "\xef\xbb\xbfIESNA:LM-63-2002\n", ""}) {
    const auto read = parse_ies(round_file(head, "0 45 90", candela, 3));
    EXPECT_EQ(read.candela, (std::vector<double>{100.0, 50.0, 0.0})) << head;
    EXPECT_EQ(read.photometry, Photometry::type_c);
  }
}

TEST(IesFile, FactorsMultiplyTheCandela) {
  // 2 of the multiplier, 0.5 of the ballast; 0.25 only where editions before 1995 have its place.
  const std::string rest = "TILT = NONE \n2 1000 2 1 1 1 2 0 0 0 0.5 0.25 50\n0\n0\n10\n";
  EXPECT_EQ(parse_ies("IESNA:LM-63-1995\n" + rest).candela.front(), 10.0);
  EXPECT_EQ(parse_ies("IESNA91\n" + rest).candela.front(), 2.5);
}

TEST(IesFile, NumbersStandInAnyLines) {
  const auto read = parse_ies(head_2002 + "TILT=NONE\n1,1000\n1 3\n2\n1 2 0\n0 0 1 1 1\n0,45\n90 0\n 90 1 2 3 4e0 5\n+6\n\x1a");
  EXPECT_EQ(read.vertical, (std::vector<double>{0.0, 45.0, 90.0}));
  EXPECT_EQ(read.horizontal, (std::vector<double>{0.0, 90.0}));
  EXPECT_EQ(read.candela, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
}

TEST(IesFile, BadFilesAreRefusedWithTheirLine) {
  const std::string start = head_2002 + "TILT=NONE\n"; // four lines
  const struct {
    std::string text, says;
    std::size_t line;
  } cases[] = {
      {"", "no line says TILT=NONE", 1},
      {"PNG\n\n", "no line says TILT=NONE", 3},
      {head_2002 + "TILT=INCLUDE\n", "TILT is not NONE", 4},
      {start + "1 1 1 3 1 3 2 0 0 0\n", "type A", 5},
      {start + "1 1 1 3 1 7 2 0 0 0\n", "photometric type 7 does not exist", 5},
      {start + "1 1 -1 3 1 1 2 0 0 0\n", "the candela multiplier is -1", 5},
      {start + "1 1 1 0 1 1 2 0 0 0\n", "number of vertical angles is 0", 5},
      {start + "1 1 1 2.5 1 1 2 0 0 0\n", "number of vertical angles is 2.5", 5},
      {start + "1 1 1 1e9 1 1 2 0 0 0\n", "number of vertical angles is 1e+09", 5},
      {start + "1 1 1 9999 9999 1 2 0 0 0\n", "9999 x 9999 angles are too many", 5},
      {start + "1 1 1 3 x 1 2 0 0 0\n", "the number of horizontal angles is no number", 5},
      {start + "1 1 nan 3 1 1 2 0 0 0\n", "the candela multiplier is no number", 5},
      {start + "1 1 1 3 1 1 2 0 0 0\n1 1 1\n0 90 45\n0\n1 2 3\n", "vertical angle 3 is 45, not over", 7},
      {start + "1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 190\n0\n1 2\n", "0 to 190 are not within 0 to 180", 7},
      {start + "1 1 1 1 2 1 2 0 0 0\n1 1 1\n0\n0 345\n1 2\n", "0 to 345 are not those of type C", 8},
      {start + "1 1 1 1 2 2 2 0 0 0\n1 1 1\n0\n-90 45\n1 2\n", "-90 to 45 are not those of type B", 8},
      {start + "1 1 1 3 1 1 2 0 0 0\n1 1 1\n0 45 90\n0\n1 2\n", "ends before candela value 3 of 3", 10},
      {start + "1 1 1 3 1 1 2 0 0 0\n1 1 1\n0 45 90\n0\n1 2\n-3\n", "candela value 3 of 3 is -3", 10},
      {start + "1 1 1 3 1 1 2 0 0 0\n1 1 1\n0 45 90\n0\n1 2 3\n4\n", "more than the 3 candela values", 10},
  };
  for (const auto& one : cases) {
    std::size_t line = 0;
    EXPECT_THAT(problem_of(one.text, &line), HasSubstr(one.says)) << one.text;
    EXPECT_EQ(line, one.line) << one.text;
  }
}

// Thousands of files broken in a few bytes each: all are read as finite numbers or refused.
TEST(IesFile, BrokenFilesAreReadOrRefused) {
  const std::string whole = head_2002 + "TILT=NONE\n1 1000 1 5 3 1 2 0.1 0.1 0\n1 1 50\n0 22.5 45 67.5 90\n"
                                        "0 45 90\n100 90 70 40 0\n80 70 60 30 0\n60 50 40 20 0\n";
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::string signs = "0123456789 .-+eE\nTILT=NA,\r\x1a\xff";
  int read = 0, refused = 0;
  for (int k = 0; k < 20'000; ++k) {
    std::string text = whole;
    for (std::size_t edits = 1 + below(3); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
      case 0: text[at] = signs[below(signs.size())]; break;
      case 1: text.erase(at, 1 + below(8)); break;
      case 2: text.insert(at, 1 + below(4), signs[below(signs.size())]); break;
      default: text.resize(at + 1); break;
      }
    }
    try {
      const IntensityDistribution d = parse_ies(text);
      ++read;
      for (int i = 0; i < 8; ++i) {
        const double candela = intensity_at(d, towards(double(below(181)), double(below(361))));
        ASSERT_TRUE(std::isfinite(candela) && candela >= 0.0) << text;
      }
    } catch (const IesProblem& problem) {
      ++refused;
      ASSERT_GE(problem.line, 1U);
      ASSERT_EQ(std::string(problem.what()).find('\n'), std::string::npos) << text;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

TEST(IntensityDistribution, IsLinearBetweenAnglesAndDarkBeyond) {
  const auto d = parse_ies(round_file(head_2002, "0 40 90", "100 60 10", 3));
  for (const double f : {0.0, 77.0, 180.0, 300.0}) {
    // Rounding of an arc tangent.
    EXPECT_NEAR(intensity_at(d, towards(0.0, f)), 100.0, 1e-9);
    EXPECT_NEAR(intensity_at(d, towards(20.0, f)), 80.0, 1e-9);
    EXPECT_NEAR(intensity_at(d, towards(65.0, f)), 35.0, 1e-9);
    EXPECT_NEAR(intensity_at(d, towards(90.0, f)), 10.0, 1e-9);
    EXPECT_EQ(intensity_at(d, towards(91.0, f)), 0.0);
  }
}

std::string quadrants(const std::string& horizontal, const std::string& candela, int count) {
  return head_2002 + "TILT=NONE\n1 -1 1 2 " + std::to_string(count) + " 1 2 0 0 0\n1 1 1\n0 90\n" +
         horizontal + "\n" + candela + "\n";
}

TEST(IntensityDistribution, SymmetriesOfTypeC) {
  // At 90 degrees from the axis, 1 + the horizontal angle in units of 90 degrees.
  const auto at = [](const IntensityDistribution& d, double f) { return intensity_at(d, towards(90.0, f)); };
  const auto quadrant = parse_ies(quadrants("0 90", "5 1 5 2", 2));
  const auto half = parse_ies(quadrants("0 90 180", "5 1 5 2 5 3", 3));
  const auto other_half = parse_ies(quadrants("90 180 270", "5 2 5 3 5 4", 3));
  const auto whole = parse_ies(quadrants("0 90 180 270 360", "5 1 5 2 5 3 5 4 5 1", 5));
  const struct {
    double angle, quadrant, half, other_half, whole;
  } cases[] = {{0.0, 1.0, 1.0, 3.0, 1.0},   {45.0, 1.5, 1.5, 2.5, 1.5},  {90.0, 2.0, 2.0, 2.0, 2.0},
               {135.0, 1.5, 2.5, 2.5, 2.5}, {180.0, 1.0, 3.0, 3.0, 3.0}, {225.0, 1.5, 2.5, 3.5, 3.5},
               {270.0, 2.0, 2.0, 4.0, 4.0}, {315.0, 1.5, 1.5, 3.5, 2.5}};
  for (const auto& c : cases) {
    EXPECT_NEAR(at(quadrant, c.angle), c.quadrant, 1e-9) << c.angle;
    EXPECT_NEAR(at(half, c.angle), c.half, 1e-9) << c.angle;
    EXPECT_NEAR(at(other_half, c.angle), c.other_half, 1e-9) << c.angle;
    EXPECT_NEAR(at(whole, c.angle), c.whole, 1e-9) << c.angle;
  }
}

TEST(IntensityDistribution, TypeBTurnsAboutItsPolarAxis) {
  // 100 at the middle, 10 more for each degree of the vertical angle, 1 for each of the horizontal.
  const auto file = [](const std::string& horizontal, const std::string& candela) {
    return parse_ies(head_2002 + "TILT=NONE\n1 -1 1 3 3 2 2 0 0 0\n1 1 1\n-40 0 40\n" + horizontal + "\n" + candela);
  };
  const auto d = file("-30 0 30", "570 970 1370 600 1000 1400 630 1030 1430");
  const auto direction = [](double vertical, double horizontal) {
    const double v = vertical * pi / 180.0, h = horizontal * pi / 180.0;
    return Direction(std::sin(v), -std::cos(v) * std::sin(h), -std::cos(v) * std::cos(h));
  };
  for (const double v : {-40.0, -12.0, 0.0, 33.0})
    for (const double h : {-30.0, -7.0, 0.0, 21.0})
      EXPECT_NEAR(intensity_at(d, direction(v, h)), 1000.0 + 10.0 * v + h, 1e-7) << v << ' ' << h;
  EXPECT_EQ(intensity_at(d, direction(41.0, 0.0)), 0.0);
  EXPECT_EQ(intensity_at(d, direction(0.0, 31.0)), 0.0);
  EXPECT_EQ(intensity_at(d, {0.0, 0.0, 1.0}), 0.0);
  const auto halves = file("0 15 30", "600 1000 1400 615 1015 1415 630 1030 1430");
  EXPECT_NEAR(intensity_at(halves, direction(5.0, -20.0)), 1070.0, 1e-7);
}

TEST(IntensityDistribution, FluxOfKnownLamps) {
  // The same everywhere: 4 pi I. Cells are exact for it.
  EXPECT_NEAR(luminous_flux(parse_ies(round_file(head_2002, "0 180", "10 10", 2))), 40.0 * pi, 1e-9);
  // A Lambertian lamp has pi I; told every 5 degrees, lines are above or below the cosine by up to
  // (5 degrees)^2 / 8 of it, 1e-3.
  std::string angles, candela;
  for (int g = 0; g <= 90; g += 5) {
    angles += std::to_string(g) + ' ';
    candela += std::to_string(100.0 * std::cos(g * pi / 180.0)) + ' ';
  }
  EXPECT_NEAR(luminous_flux(parse_ies(round_file(head_2002, angles, candela, 19))), 100.0 * pi, 0.1 * pi);
}

} // namespace
} // namespace meninas::test
