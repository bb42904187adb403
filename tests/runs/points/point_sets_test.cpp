// Lists of points, and what is written about them.
#include "runs/points/point_report.h"
#include "scenes/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace meninas::test {
namespace {

using testing::HasSubstr;

std::string problem_of(const std::string& text) {
  try {
    parse_points(text, "p.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(PointSets, ReadWithAndWithoutHeaderAndNormals) {
  const std::string rows = "1,2,3,0,0,2\r\n\n# a remark\n-1e-1;+2.5; 3\n4\t5\t6\t1\t0\t0";
  for (const std::string& text : {rows, "x,y,z,nx,ny,nz\n" + rows}) {
    const auto points = parse_points(text, "p.csv");
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].position, Point3(1, 2, 3));
    EXPECT_EQ(points[0].normal, Vec3(0, 0, 1)) << "of unit length";
    EXPECT_EQ(points[1].position, Point3(-0.1, 2.5, 3));
    EXPECT_EQ(points[1].normal, Vec3(0, 1, 0)) << "up";
    EXPECT_EQ(points[2].normal, Vec3(1, 0, 0));
  }
}

TEST(PointSets, BadLinesAreNamed) {
  EXPECT_EQ(problem_of("x,y,z\n1,2\n"), "p.csv: line 2: 2 values, not 3 (x, y, z) or 6 (and nx, ny, nz)");
  EXPECT_EQ(problem_of("1,2,3\n1,2,here\n"), "p.csv: line 2: value 3 is no number, or a huge one");
  EXPECT_EQ(problem_of("1,2,inf\n"), "p.csv: line 1: value 3 is no number, or a huge one");
  EXPECT_EQ(problem_of("1,2,3,0,0,0\n"), "p.csv: line 1: the normal has no length");
  EXPECT_EQ(problem_of("x,y,z\nx,y,z\n"), "p.csv: line 2: value 1 is no number, or a huge one");
  EXPECT_EQ(problem_of("x,y,z\n"), "p.csv: has no points");
  EXPECT_EQ(problem_of(""), "p.csv: has no points");
}

TEST(PointSets, AreNeverReadAsOthers) {
  EXPECT_EQ(problem_of("0,5;1,2;0,8\n"), "p.csv: has no points") << "a header: no number in it";
  EXPECT_EQ(problem_of("x;y;z\n0,5;1,2;0,8\n"), "p.csv: line 2: value 1 is no number, or a huge one");
  EXPECT_EQ(problem_of("1,2,3\n1,,2,3\n"), "p.csv: line 2: 4 values, not 3 (x, y, z) or 6 (and nx, ny, nz)");
  EXPECT_EQ(problem_of("nan,0,0\n"), "p.csv: line 1: value 1 is no number, or a huge one");
  const auto marked = parse_points("\xEF\xBB\xBF" "1,0.75,1\n2,0.75,1", "p.csv");
  ASSERT_EQ(marked.size(), 2U) << "a byte order mark is no header";
  EXPECT_EQ(marked[0].position, Point3(1, 0.75, 1));
}

MeasuredSet measured(const std::string& name, Rgb total) {
  MeasuredSet set{{name, {{{1, 2, 3}, {0, 1, 0}}}, std::nullopt}, {{total, 0.5 * total, 0.25 * total}}, 100.0};
  return set;
}

TEST(PointSets, TablesSayLuxAndWatts) {
  const std::vector<MeasuredSet> sets{measured("a, b", Rgb(2.0, 1.0, 0.0))};
  // 100 (0.2126 * 2 + 0.7152)
  const std::string csv = points_csv(sets);
  EXPECT_THAT(csv, testing::StartsWith("set,x_m,y_m,z_m,nx,ny,nz,illuminance_lx,"));
  EXPECT_THAT(csv, HasSubstr("\n\"a, b\",1,2,3,0,1,0,114.04,57.02,28.51,2,1,0,1,0.5,0,0.5,0.25,0\n"));
  const auto json = nlohmann::json::parse(points_json(sets));
  EXPECT_EQ(json["units"]["illuminance"], "lx");
  EXPECT_NEAR(json["sets"][0]["points"][0]["illuminance_direct"].get<double>(), 57.02, 1e-9);
  EXPECT_NEAR(json["sets"][0]["mean"].get<double>(), 114.04, 1e-9);
}

TEST(PointSets, SidesWithoutLightAreLeftOut) {
  const auto side = [](const std::string& name, double light, bool back) {
    MeasuredSet set = measured(name, Rgb(light));
    set.set.grid = MeasuringGrid{.node = "sheet", .back = back};
    return set;
  };
  const auto kept = [](std::vector<MeasuredSet> sets) {
    std::vector<std::string> names;
    for (const MeasuredSet& set : without_dark_sides(std::move(sets)))
      names.push_back(set.set.name);
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(kept({side("front", 1, false), side("back", 0, true)}), (Names{"front"}));
  EXPECT_EQ(kept({side("front", 0, false), side("back", 1, true)}), (Names{"back"}));
  EXPECT_EQ(kept({side("front", 0, false), side("back", 0, true)}), (Names{"front"}));
  EXPECT_EQ(kept({side("front", 1, false), side("back", 1, true)}), (Names{"front", "back"}));
  EXPECT_EQ(kept({measured("points", Rgb(0.0))}), (Names{"points"}));
}

TEST(PointSets, GridsLeaveOutWhatLiesInsideOfThings) {
  MeasuredSet set = measured("floor", Rgb(1.0));
  set.set.points.push_back({{4, 5, 6}, {0, 1, 0}});
  set.light.push_back({.inside = true});
  EXPECT_EQ(without_points_inside(set).light.size(), 2U) << "points that were asked for are all there";
  set.set.grid = MeasuringGrid{.node = "floor"};
  const MeasuredSet kept = without_points_inside(set);
  EXPECT_EQ(kept.light.size(), 1U);
  EXPECT_EQ(kept.set.points.size(), 1U);
  EXPECT_EQ(kept.inside, 1U);
  EXPECT_THAT(summary_line(kept), HasSubstr("(1 point inside of things left out)"));
  set.light.front() = set.light.back();
  EXPECT_EQ(without_points_inside(set).light.size(), 2U);
}

TEST(PointSets, NamesOfTables) {
  EXPECT_THROW(check_points_file("a.txt"), OutputError);
  EXPECT_NO_THROW(check_points_file("a.csv"));
  EXPECT_NO_THROW(check_points_file("a.json"));
}

} // namespace
} // namespace meninas::test
