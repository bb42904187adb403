// Numbers in lux: points, grids, views, units and luminaires, as the program says and writes them.
#include "image/image_file.h"
#include "tests/cli/program.h"
#include "tests/cli/tiny_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numbers>
#include <sstream>

namespace meninas::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

class Lux : public testing::Test {
protected:
  Lux() { write_room(folder_ / "room.glb", tiny_room()); }

  Outcome run(std::vector<std::string> arguments) { return run_program(folder_.path(), arguments); }

  /// solve, quickly, with these options.
  Outcome solved(std::vector<std::string> options, const std::string& scene = "room.glb") {
    options.insert(options.begin(), {"solve", scene, "-o", "out.glb", "--quality", "draft", "--elements", "600"});
    return run(options);
  }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  /// Rows of a table, header aside, as their numbers from the second column on.
  std::vector<std::vector<double>> rows_of(const std::string& name) {
    std::istringstream lines(read_file(folder_ / name));
    std::vector<std::vector<double>> rows;
    std::string line, field;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      rows.emplace_back();
      std::getline(fields, field, ',');
      while (std::getline(fields, field, ','))
        rows.back().push_back(std::stod(field));
    }
    return rows;
  }

  TemporaryFolder folder_;
};

constexpr std::size_t illuminance = 6, direct = 7, by_mirrors = 8, irradiance = 9; // columns of a row

/// A black room of nothing but a point lamp of 100 lm above its floor: of black metal, which has no coat.
TinyRoom lamp_room() {
  TinyRoom room = tiny_room();
  for (json& material : room.root["materials"]) {
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.0, 0.0, 0.0, 1.0};
    material["pbrMetallicRoughness"]["metallicFactor"] = 1.0;
    material["pbrMetallicRoughness"]["roughnessFactor"] = 1.0;
    material.erase("emissiveFactor");
  }
  room.root["extensionsUsed"] = {"KHR_lights_punctual"};
  room.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 100.0 / (4.0 * pi)}}});
  room.root["scenes"][0]["nodes"].push_back(room.root["nodes"].size());
  room.root["nodes"].push_back({{"name", "bulb"},
                                {"translation", {0.5, 0.8, 0.8}},
                                {"rotation", {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return room;
}

TEST_F(Lux, PointsAreReportedBesideTheSolution) {
  write("p.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0.5,0,1,0\n0.5,0,0.5,0,1,0\n0.5,0.5,0.5,0,-1,0\n");
  const Outcome out = solved({"--points", "p.csv", "--points-out", "q.json"});
  ASSERT_EQ(out.code, 0) << out.err;
  EXPECT_THAT(out.err, HasSubstr("points: 3 points, illuminance"));
  ASSERT_EQ(solved({"--points", "p.csv"}).code, 0);
  const auto rows = rows_of("out.points.csv");
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 18U);
    // Grey light: 683 lux to the watt. Seven digits are written.
    EXPECT_NEAR(row[illuminance], 683.0 * row[irradiance], 2e-6 * row[illuminance]);
    EXPECT_LE(row[direct], row[illuminance]);
    EXPECT_GT(row[by_mirrors], 0.0);
  }
  EXPECT_GT(rows[0][direct], rows[1][direct]) << "nearer to the lamp";
  EXPECT_EQ(rows[2][direct], 0.0) << "it faces the floor";
  const json read = json::parse(read_file(folder_ / "q.json"));
  EXPECT_NEAR(read["sets"][0]["points"][1]["illuminance"].get<double>(), rows[1][illuminance], 2e-6 * rows[1][illuminance]);
}

// 0.8 m within the margin: p = 0.171, five points along each side.
TEST_F(Lux, AGridSaysHowEvenTheLightIs) {
  const Outcome out = solved({"--grid", "floor", "--grid-margin", "0.1", "--points-out", "g.json", "--per-node", "n.json"});
  ASSERT_EQ(out.code, 0) << out.err;
  EXPECT_THAT(out.err, HasSubstr("grid floor: 25 points 0.16 x 0.16 m apart, illuminance"));
  EXPECT_THAT(out.err, HasSubstr("lx in the mean"));
  const json set = json::parse(read_file(folder_ / "g.json"))["sets"][0];
  EXPECT_EQ(set["points"].size(), 25U);
  EXPECT_NEAR(set["uniformity"].get<double>(), set["minimum"].get<double>() / set["mean"].get<double>(), 1e-12);
  for (const json& node : json::parse(read_file(folder_ / "n.json"))["nodes"])
    if (node["name"] == "floor") {
      EXPECT_NEAR(node["illuminance"].get<double>(), 683.0 * node["irradiance"][1].get<double>(), 1e-6);
      // The middle of the floor is a little brighter than all of it.
      EXPECT_NEAR(node["illuminance"].get<double>(), set["mean"].get<double>(), 0.15 * set["mean"].get<double>());
    }
}

TEST_F(Lux, ALampIsWhatItsUnitsSay) {
  write_room(folder_ / "lamp.glb", lamp_room());
  // 0.6 m below the lamp, which stands before no mirror: I / d^2.
  write("p.csv", "0.5,0.2,0.8\n");
  const auto lux_of = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--points", "p.csv"});
    const Outcome out = solved(options, "lamp.glb");
    EXPECT_EQ(out.code, 0) << out.err;
    return rows_of("out.points.csv").front()[illuminance];
  };
  const double expected = 100.0 / (4.0 * pi) / 0.36;
  // Floats of the file.
  EXPECT_NEAR(lux_of({"--units", "photometric"}), expected, 1e-5 * expected);
  EXPECT_NEAR(lux_of({}), 683.0 * expected, 683e-5 * expected);
  EXPECT_NEAR(lux_of({"--luminous-efficacy", "100"}), 100.0 * expected, 1e-3 * expected);
  EXPECT_NEAR(lux_of({"--units", "photometric", "--luminous-efficacy", "179"}), expected, 1e-5 * expected);

  // The node's -Z is down. 50 cd where it aims, whatever the light's intensity is.
  write("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n50 0\n");
  EXPECT_NEAR(lux_of({"--ies", "bulb=lamp.ies"}), 50.0 / 0.36, 1e-5 * 50.0 / 0.36);
}

TEST_F(Lux, ViewsInLuxAndCandela) {
  const std::vector<std::string> common{"--quality", "draft", "--elements", "600", "--size", "240x200"};
  const auto layer = [&](const std::string& view, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", "room.glb", "-o", view + ".exr", "-o", view + ".png", "--view", view});
    options.insert(options.end(), common.begin(), common.end());
    const Outcome out = run(options);
    EXPECT_EQ(out.code, 0) << out.err;
    EXPECT_THAT(out.err, HasSubstr("view " + view + ": from 0 (black) to"));
    const ImageFile file = read_image(folder_ / (view + ".exr"));
    EXPECT_EQ(file.layers.size(), 1U);
    return file.layers.front().image;
  };
  const Image lux = layer("illuminance", {}), watts = layer("irradiance", {});
  for (std::size_t p = 0; p < lux.pixels.size(); ++p)
    ASSERT_NEAR(lux.pixels[p].g, 683.0F * watts.pixels[p].g, 1e-3F * lux.pixels[p].g);
  const Image candela = layer("luminance", {"--samples", "4"});
  std::vector<std::string> plain{"render", "room.glb", "-o", "plain.exr", "--float", "--samples", "4"};
  plain.insert(plain.end(), common.begin(), common.end());
  ASSERT_EQ(run(plain).code, 0);
  const Image radiance = read_image(folder_ / "plain.exr").picture;
  for (std::size_t p = 0; p < candela.pixels.size(); ++p) {
    const glm::vec3& l = radiance.pixels[p];
    const double expected = 683.0 * (0.2126 * l.r + 0.7152 * l.g + 0.0722 * l.b);
    ASSERT_NEAR(candela.pixels[p].g, expected, 1e-5 * expected + 1e-9);
  }
}

TEST_F(Lux, RadiancePicturesHoldTheLight) {
  const Outcome out = run({"render", "room.glb", "-o", "a.hdr", "-o", "a.exr", "--float", "--quality", "draft", "--elements", "600", "--size", "60x50"});
  ASSERT_EQ(out.code, 0) << out.err;
  const Image hdr = read_image(folder_ / "a.hdr").picture, exr = read_image(folder_ / "a.exr").picture;
  ASSERT_EQ(hdr.width, 60);
  for (std::size_t p = 0; p < hdr.pixels.size(); ++p)
    for (int c = 0; c < 3; ++c)
      // A step of the mantissa they share: 1 / 128 of the brightest channel at most.
      ASSERT_NEAR(hdr.pixels[p][c], exr.pixels[p][c], std::max({exr.pixels[p].r, exr.pixels[p].g, exr.pixels[p].b}) / 128.0F);
}

TEST_F(Lux, WhatDoesNotGoTogether) {
  const auto says = [&](int code, std::vector<std::string> arguments, const std::string& text) {
    const Outcome out = run(arguments);
    EXPECT_EQ(out.code, code) << out.err;
    EXPECT_THAT(out.err, HasSubstr(text));
  };
  const std::vector<std::string> solve{"solve", "room.glb", "-o", "s.glb"};
  const auto with = [](std::vector<std::string> a, std::vector<std::string> b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  says(2, with(solve, {"--grid-margin", "1"}), "--grid-margin: has no effect without --grid");
  says(2, with(solve, {"--points-out", "p.csv"}), "--points-out: has no effect without --points or --grid");
  says(2, with(solve, {"--grid", "flor"}), "no node 'flor', did you mean 'floor'?");
  says(2, with(solve, {"--grid", "floor", "--grid-margin", "0.6"}), "--grid: node 'floor' has no room for a point within --grid-margin");
  says(2, with(solve, {"--grid", "floor", "--grid-height", "-1"}), "--grid-height: cannot be negative");
  says(3, with(solve, {"--points", "missing.csv"}), "missing.csv: no such file");
  says(4, with(solve, {"--grid", "floor", "--points-out", "p.txt"}), "p.txt: cannot write points");
  write("bad.csv", "1,2,3\n1,2\n");
  says(3, with(solve, {"--points", "bad.csv"}), "bad.csv: line 2: 2 values");
  says(2, with(solve, {"--points", "bad.csv", "--points-out", "bad.csv"}), "is an input");
  says(2, with(solve, {"--ies", "bulb=lamp.ies", "--stats", "lamp.ies"}), "is an input");
  says(2, {"render", "room.glb", "--environment", "sky.hdr", "-o", "sky.hdr"}, "is an input");
  says(2, with(solve, {"--ies", "bulb"}), "--ies: takes LIGHT=FILE");
  says(2, with(solve, {"--ies", "bulb=x.ies"}), "no light 'bulb'");
  says(2, with(solve, {"--luminous-efficacy", "100", "--sky", "overcast"}), "--luminous-efficacy: does not go with --sky");
  says(2, {"render", "room.glb", "--view", "illuminance", "-o", "v.hdr"}, "--view: has no light for a .hdr");
  says(2, {"render", "room.glb", "--view", "illuminance", "--samples", "4"}, "--samples: has no effect with --view");
  EXPECT_EQ(files_in(folder_.path()), (std::vector<std::string>{"bad.csv", "room.glb"}));
}

} // namespace
} // namespace meninas::test
