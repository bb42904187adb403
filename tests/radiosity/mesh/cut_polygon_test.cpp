// Polygons cut along segments.
#include "radiosity/mesh/cut_polygon.h"
#include "scenes/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas {
namespace {

const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr double grain = 1e-4;

std::vector<double> region_areas(const CutPolygon& cut) {
  std::vector<double> areas(cut.regions, 0.0);
  for (std::size_t p = 0; p < cut.pieces.size(); ++p)
    areas[cut.region[p]] += area_of(cut.pieces[p]);
  return areas;
}

std::uint32_t region_at(const CutPolygon& cut, Vec2 x) {
  if (cut.lines.empty())
    return 0;
  std::uint32_t next = 0;
  while ((next & CutLine::piece) == 0)
    next = cut.lines[next].next[glm::dot(cut.lines[next].normal, x) < cut.lines[next].offset ? 0 : 1];
  return cut.region[next & ~CutLine::piece];
}

TEST(CutPolygon, AWallMakesTwoRegions) {
  const std::vector<Segment2> wall{{{0.3, -0.5}, {0.3, 1.5}}};
  const CutPolygon cut = cut_polygon(square, wall, grain);
  ASSERT_EQ(cut.regions, 2U);
  const auto areas = region_areas(cut);
  EXPECT_NEAR(std::min(areas[0], areas[1]), 0.3, 1e-12);
  EXPECT_NEAR(areas[0] + areas[1], 1.0, 1e-12);
  EXPECT_NE(region_at(cut, {0.29, 0.5}), region_at(cut, {0.31, 0.5}));
}

TEST(CutPolygon, AFootIsOneRegionAndAllAroundItAnother) {
  // A hexagon's outline, whose lines cut what is around it into several pieces.
  std::vector<Segment2> outline;
  const auto corner = [](int k) {
    const double angle = k * std::numbers::pi / 3.0;
    return Vec2(0.45 + 0.2 * std::cos(angle), 0.55 + 0.2 * std::sin(angle));
  };
  for (int k = 0; k < 6; ++k)
    outline.push_back({corner(k), corner(k + 1)});
  const CutPolygon cut = cut_polygon(square, outline, grain);
  ASSERT_EQ(cut.regions, 2U);
  EXPECT_NEAR(region_areas(cut)[region_at(cut, {0.45, 0.55})], 1.5 * std::sqrt(3.0) * 0.04, 1e-12);
  EXPECT_EQ(region_at(cut, {0.05, 0.05}), region_at(cut, {0.95, 0.95}));
}

TEST(CutPolygon, ANarrowGapBesideAWallsEndJoinsNoSides) {
  // A wall of a tenth that ends below the border by `gap`: its two faces and its top.
  const auto wall = [](double gap) {
    const double top = 1.0 - gap;
    return std::vector<Segment2>{
        {{0.4, -0.5}, {0.4, top}}, {{0.5, top}, {0.5, -0.5}}, {{0.4, top}, {0.5, top}}};
  };
  for (const double gap : {0.002, 0.05}) {
    const CutPolygon cut = cut_polygon(square, wall(gap), grain);
    EXPECT_NE(region_at(cut, {0.2, 0.5}), region_at(cut, {0.8, 0.5})) << gap;
  }
  const CutPolygon round_its_end = cut_polygon(square, wall(0.5), grain);
  EXPECT_EQ(region_at(round_its_end, {0.39, 0.9}), region_at(round_its_end, {0.51, 0.9}));
}

TEST(CutPolygon, WhatLiesOnABorderCutsNothing) {
  EXPECT_EQ(cut_polygon(square, std::vector<Segment2>{{{0, -1}, {0, 2}}}, grain).regions, 1U);
  EXPECT_EQ(cut_polygon(square, std::vector<Segment2>{{{1.5, -1}, {1.5, 2}}}, grain).regions, 1U);
  EXPECT_EQ(cut_polygon(square, std::vector<Segment2>{{{-1, 1}, {1, -1}}}, grain).regions, 1U);
}

TEST(CutPolygon, TwoWallsOneOverTheOtherAreOne) {
  const std::vector<Segment2> twice{{{0.3, 0.0}, {0.3, 0.7}}, {{0.3, 1.0}, {0.3, 0.4}},
                                    {{0.3, 0.1}, {0.3, 0.2}}};
  EXPECT_EQ(cut_polygon(square, twice, grain).pieces.size(), 2U);
}

TEST(CutPolygon, PiecesAreConvexAndMakeUpThePolygonWhateverCutsIt) {
  const std::vector<Vec2> triangle{{0, 0}, {2, 0.1}, {0.4, 1.3}};
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    std::vector<Segment2> segments;
    for (std::uint32_t k = 0; k < 1 + seed % 7; ++k) {
      const auto a = sobol4(k, hash(seed, 1)), b = sobol4(k, hash(seed, 2));
      segments.push_back({{2.0 * a[0], 1.3 * a[1]}, {2.0 * b[0], 1.3 * b[1]}});
    }
    for (const auto& polygon : {square, triangle}) {
      const CutPolygon cut = cut_polygon(polygon, segments, grain);
      double area = 0.0;
      for (const auto& piece : cut.pieces) {
        area += area_of(piece);
        for (std::size_t k = 0; k < piece.size(); ++k) {
          const std::vector<Vec2> corner{piece[k], piece[(k + 1) % piece.size()],
                                         piece[(k + 2) % piece.size()]};
          EXPECT_GT(area_of(corner), -1e-12);
        }
      }
      EXPECT_NEAR(area, area_of(polygon), 1e-9);
    }
  }
}

TEST(CutPolygon, WhatIsMetAlongAWayIsInOrder) {
  const std::vector<Segment2> segments{{{0.8, -1}, {0.8, 1}}, {{0.2, 0}, {0.4, 0}},
                                       {{0.35, 0}, {0.5, 0}}, {{0.6, 0.5}, {0.6, 1}}};
  const auto met = met_along({0, 0}, {1, 0}, segments, grain);
  ASSERT_EQ(met.size(), 2U);
  EXPECT_NEAR(met[0].from, 0.2, 2.0 * grain);
  EXPECT_NEAR(met[0].to, 0.5, 2.0 * grain);
  EXPECT_NEAR(met[1].from, 0.8, 2.0 * grain);
}

} // namespace
} // namespace meninas
