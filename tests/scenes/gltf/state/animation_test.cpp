// Poses at a time, by the interpolations of glTF 2.0, Appendix C, and files that say them wrongly.
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meninas::test {
namespace {

using testing::HasSubstr;

// Keys are floats, and sines and products in doubles add a few roundings to them.
constexpr double rounding = 1e-7;

Scene at(const GltfFile& file, double seconds) { return load(file, {.state = {.at = seconds}}); }
std::string error_at(const GltfFile& file, double seconds) {
  return error_of(file, {.state = {.at = seconds}});
}

/// The square, one property of its node moved by a channel.
GltfFile moved(const std::string& path, const std::string& interpolation,
               const std::vector<float>& times, const std::vector<float>& values) {
  auto file = square();
  animate(file, 0, path, interpolation, times, values);
  return file;
}

void expect_corner(const Scene& scene, std::size_t vertex, const Point3& expected) {
  EXPECT_LT(glm::distance(scene.vertices.at(vertex).position, expected), rounding)
      << scene.vertices.at(vertex).position.x << ' ' << scene.vertices.at(vertex).position.y << ' '
      << scene.vertices.at(vertex).position.z;
}

TEST(GltfAnimation, LinearValuesLieBetweenTheirKeysAndStayBeyondThem) {
  const auto file = moved("translation", "LINEAR", {1, 3, 4}, {0, 0, 0, 4, 8, 0, 4, 8, 1});
  expect_corner(at(file, 1.5), 0, {1, 2, 0});
  expect_corner(at(file, 3.0), 0, {4, 8, 0});
  expect_corner(at(file, 3.75), 0, {4, 8, 0.75});
  expect_corner(at(file, -7.0), 0, {0, 0, 0});
  EXPECT_TRUE(at(file, 4.0).warnings.empty());
  const Scene after = at(file, 9.0);
  expect_corner(after, 0, {4, 8, 1});
  EXPECT_TRUE(warns(after, {"--at 9 is after the end of the animations, at 4 s"}));
}

TEST(GltfAnimation, StepsHoldTheirValueUpToTheNextKey) {
  const auto file = moved("scale", "STEP", {0, 1}, {1, 1, 1, 5, 6, 7});
  expect_corner(at(file, 0.999), 2, {1, 1, 0});
  expect_corner(at(file, 1.0), 2, {5, 6, 0});
}

TEST(GltfAnimation, CubicSplinesAreTheCubicOfTheirEnds) {
  // t^3, 2 t^2 and -t from 1 to 3, with their derivatives in the keys, which a cubic between them is.
  const auto file = moved("translation", "CUBICSPLINE", {1, 3},
                          {99, 99, 99, 1, 2, -1, 3, 4, -1, 27, 12, -1, 27, 18, -3, 99, 99, 99});
  for (const double t : {1.0, 1.25, 2.0, 2.875, 3.0})
    expect_corner(at(file, t), 0, {t * t * t, 2.0 * t * t, -t});
  expect_corner(at(file, 0.0), 0, {1, 2, -1});
  expect_corner(at(file, 5.0), 0, {27, 18, -3});
}

TEST(GltfAnimation, RotationsTurnEvenlyTheShorterWay) {
  // By 170 degrees about z; a chord between the quaternions would be at 37 degrees after a quarter.
  const double half = std::numbers::pi * 85.0 / 180.0;
  const auto s = static_cast<float>(std::sin(half)), c = static_cast<float>(std::cos(half));
  for (const float sign : {1.0F, -1.0F}) {
    // Lengths say nothing.
    const auto file =
        moved("rotation", "LINEAR", {0, 4}, {0, 0, 0, 2, 0, 0, sign * 3 * s, sign * 3 * c});
    for (const double u : {0.0, 0.25, 0.5, 1.0}) {
      const double angle = 2.0 * half * u;
      expect_corner(at(file, 4.0 * u), 1, {std::cos(angle), std::sin(angle), 0});
    }
  }
}

TEST(GltfAnimation, RotationsMayBeFractionsOfIntegersAndSplines) {
  auto file = moved("rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
  const auto output = file.add_accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4");
  file.json["accessors"][output]["normalized"] = true;
  file.json["animations"][0]["samplers"][0]["output"] = output;
  expect_corner(at(file, 0.5), 1, {0, 1, 0});
  // Flat tangents: half of both keys at half of the way, made a unit quaternion.
  const auto spline = moved("rotation", "CUBICSPLINE", {0, 1},
                            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,  //
                             0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
  expect_corner(at(spline, 0.5), 1, {0, 1, 0});
  EXPECT_TRUE(at(spline, 0.5).warnings.empty());
}

TEST(GltfAnimation, WeightsMoveMorphTargets) {
  // The second target lifts by 4; a key has a weight for each.
  for (const std::string interpolation : {"LINEAR", "CUBICSPLINE"}) {
    auto file = morphed_square();
    const bool spline = interpolation == "CUBICSPLINE";
    animate(file, 0, "weights", interpolation, {0, 1},
            spline ? std::vector<float>{0, 0, 7, 0, 0, 0, 0, 0, 7, 1, 0, 0}
                   : std::vector<float>{7, 0, 7, 1});
    expect_corner(at(file, 0.5), 0, {0, 0, 2});
    EXPECT_FALSE(warns(at(file, 0.5), {"morph"}));
  }
}

TEST(GltfAnimation, SkinsCamerasAndLightsGoWithTheirNodes) {
  auto file = skinned_square();
  animate(file, 2, "translation", "LINEAR", {0, 2}, {0, 0, 0, 0, 2, 0});
  file.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}}}}});
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  file.json["nodes"][2]["children"] = {3};
  file.add_node({{"camera", 0},
                 {"translation", {0, 0, 1}},
                 {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Scene scene = at(file, 1.0);
  expect_corner(scene, 0, {1, 1, 0}); // Root is at (1, 0, 0)
  EXPECT_EQ(scene.cameras.at(0).position, Point3(1, 1, 1));
  EXPECT_EQ(scene.lights.at(0).position, Point3(1, 1, 1));
  EXPECT_FALSE(warns(scene, {"skins"}));
}

TEST(GltfAnimation, OfSeveralTheLastInTheFileMovesANode) {
  auto file = moved("translation", "STEP", {0}, {1, 0, 0});
  animate(file, 0, "scale", "STEP", {0}, {3, 1, 1});
  EXPECT_TRUE(at(file, 0.0).warnings.empty()) << "of different properties all do";
  expect_corner(at(file, 0.0), 1, {4, 0, 0});
  animate(file, 0, "translation", "STEP", {0}, {5, 0, 0});
  const Scene scene = at(file, 0.0);
  expect_corner(scene, 1, {8, 0, 0});
  EXPECT_TRUE(warns(scene, {"several animations move nodes", "'Quad'"}));
}

TEST(GltfAnimation, WithoutATimeTheRestPoseIsShown) {
  const auto file = moved("translation", "STEP", {0}, {1, 0, 0});
  const Scene scene = load(file);
  EXPECT_EQ(scene.vertices[0].position, Point3(0, 0, 0));
  EXPECT_TRUE(warns(scene, {"animations are left out", "'animation0'"}));
  EXPECT_EQ(scene.ignored, std::vector<std::string>{"animations"});
  EXPECT_TRUE(at(file, 0.0).ignored.empty());
  EXPECT_TRUE(warns(at(square(), 0.0), {"no animation for --at"}));
}

TEST(GltfAnimation, WhatCannotMoveIsNamed) {
  auto file = moved("translation", "STEP", {0}, {1, 0, 0});
  file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 7, 0, 1};
  const Scene fixed = at(file, 0.0);
  EXPECT_EQ(fixed.vertices[0].position, Point3(0, 7, 0));
  EXPECT_TRUE(warns(fixed, {"have a matrix stay", "'Quad'"}));

  auto weights = moved("weights", "STEP", {0}, {1});
  EXPECT_TRUE(warns(at(weights, 0.0), {"without morph targets", "'Quad'"}));

  auto pointer = moved("translation", "STEP", {0}, {1, 0, 0});
  auto& target = pointer.json["animations"][0]["channels"][0]["target"];
  target = {{"path", "pointer"},
            {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/emissiveFactor"}}}}}};
  const Scene rest = at(pointer, 0.0);
  EXPECT_EQ(rest.vertices[0].position, Point3(0, 0, 0));
  EXPECT_TRUE(warns(rest, {"left out", "'KHR_animation_pointer'"}));
  target = {{"node", 0}, {"path", "colour"}};
  EXPECT_TRUE(warns(at(pointer, 0.0), {"animated properties are left out", "'colour'"}));

  auto zero = moved("rotation", "STEP", {0}, {0, 0, 0, 0});
  EXPECT_EQ(at(zero, 0.0).vertices[1].position, Point3(1, 0, 0));
  EXPECT_TRUE(warns(at(zero, 0.0), {"rotations that are zero", "'Quad'"}));
}

struct BadKeys {
  const char* what;
  std::vector<float> times, values;
  const char* line;
};

TEST(GltfAnimation, KeysThatMakeNoSenseAreRefusedWithTheirPlace) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const BadKeys cases[] = {
      {"no time", {nan, 1}, {0, 0, 0, 0, 0, 0}, "the time of key 0 is not finite"},
      {"endless", {0, inf}, {0, 0, 0, 0, 0, 0}, "the time of key 1 is not finite"},
      {"backwards", {2, 1}, {0, 0, 0, 0, 0, 0}, "key 1, at 1 s, is after that at 2 s"},
      {"few", {0, 1}, {0, 0, 0}, "2 keys of 'translation' need 2 values, there are 1"},
      {"no value", {0, 1}, {0, nan, 0, 0, 0, 0}, "a value is not finite"},
  };
  for (const BadKeys& bad : cases)
    EXPECT_THAT(error_at(moved("translation", "LINEAR", bad.times, bad.values), 0.5),
                HasSubstr(std::string("scene.gltf: animations[0], channel 0: ") + bad.line))
        << bad.what;
  EXPECT_EQ(at(moved("translation", "LINEAR", {0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}), 1.0)
                .vertices[0].position,
            Point3(5, 0, 0))
      << "two keys at one time are a jump";
}

TEST(GltfAnimation, ReferencesAndTypesAreChecked) {
  const std::tuple<const char*, Json, const char*> edits[] = {
      {"/animations/0/channels/0/sampler", 7, "'sampler' is index 7 of samplers, there are 1"},
      {"/animations/0/channels/0/sampler", -1, "'sampler' must be a whole number of at least 0"},
      {"/animations/0/channels/0/target/node", 7, "'node' is index 7 of nodes, there are 1"},
      {"/animations/0/channels/0/target/path", 7, "'path' must be text, it is 7"},
      {"/animations/0/samplers/0/input", 70, "'input' is index 70 of accessors"},
      {"/animations/0/samplers/0/output", "x", "'output' must be an index, it is a string"},
      {"/animations/0/samplers/0/input", 0, "accessors[0]: type must be SCALAR for this use"},
      {"/animations/0/samplers/0/output", 2, "accessors[2]: type must be VEC3 for this use"},
      {"/animations/0/samplers/0/interpolation", "SMOOTH", "interpolation 'SMOOTH' does not exist"},
      {"/animations/0/samplers/0", Json::object(), "its sampler has no 'input'"},
      {"/animations/0/channels/0", {{"target", {{"node", 0}, {"path", "scale"}}}}, "has no 'sampler'"},
      {"/accessors/2/count", 0, "has no keys"},
  };
  for (const auto& [pointer, value, line] : edits) {
    auto file = moved("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 1, 1});
    file.json[Json::json_pointer(pointer)] = value;
    EXPECT_THAT(error_at(file, 0.5), HasSubstr(line)) << pointer << ' ' << value;
  }
}

// Accessors without a buffer are zeros without end, and any number of channels may name one.
TEST(GltfAnimation, ThereIsABoundOnKeys) {
  auto file = moved("translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 1, 1});
  for (const std::size_t accessor : {2, 3}) {
    file.json["accessors"][accessor].erase("bufferView");
    file.json["accessors"][accessor]["count"] = 20'000'000;
  }
  EXPECT_THAT(error_at(file, 0.5), HasSubstr("over 50000000 numbers"));
  for (const std::size_t accessor : {2, 3})
    file.json["accessors"][accessor]["count"] = std::uint64_t{1} << 62;
  EXPECT_THAT(error_at(file, 0.5), HasSubstr("over 50000000 numbers"));
}

} // namespace
} // namespace meninas::test
