// EXT_lights_area: flat lights along the -Z of their node.
#include "scenes/area_light.h"
#include "scenes/lamps.h"
#include "scenes/repair/touching.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using testing::HasSubstr;

/// The square below an area light at (0, 0, 2), whose -Z is down.
GltfFile lit_square(const Json& light, Json node = {{"name", "panel"}}) {
  auto file = square();
  file.json["extensions"]["EXT_lights_area"]["lights"] = Json::array({light});
  file.json["extensionsUsed"] = {"EXT_lights_area"};
  if (!node.contains("translation"))
    node["translation"] = {0.0, 0.0, 2.0};
  node["extensions"]["EXT_lights_area"]["light"] = 0;
  file.add_node(node);
  return file;
}

const Json rectangle{{"type", "rect"}, {"intensity", 20.0}, {"color", {1.0, 0.5, 0.25}}, {"size", 0.5},
                     {"rect", {{"aspect", 3.0}}}};

TEST(GltfAreaLights, RectanglesHaveTheirNodesPlaceAndLargestScale) {
  const Scene scene = load(lit_square(rectangle, {{"name", "panel"}, {"scale", {1.0, 2.0, 0.5}}}));
  EXPECT_TRUE(scene.ignored.empty());
  ASSERT_EQ(scene.area_lights.size(), 1U);
  const AreaLight& light = scene.area_lights[0];
  EXPECT_EQ(light.name, "panel");
  EXPECT_EQ(light.radiance, Rgb(20.0, 10.0, 5.0));
  EXPECT_NEAR(light.axis.z, -1.0, 1e-12);
  EXPECT_NEAR(area_of(light), 1.0 * 3.0, 1e-9) << "twice 0.5 high, thrice as wide";
  Bounds box;
  for (const Point3& corner : light.corners) {
    box.low = glm::min(box.low, corner);
    box.high = glm::max(box.high, corner);
    EXPECT_NEAR(corner.z, 2.0, 1e-12);
  }
  EXPECT_NEAR(box.high.x - box.low.x, 3.0, 1e-9);
  EXPECT_NEAR(box.high.y - box.low.y, 1.0, 1e-9);
  // Its corners turn about the way it shines, from where that is seen.
  EXPECT_TRUE(lit_crossing(light, {0.2, 0.1, 0.0}, {0.0, 0.0, 1.0}).has_value());
  EXPECT_FALSE(lit_crossing(light, {0.2, 0.1, 3.0}, {0.0, 0.0, -1.0}).has_value()) << "from behind";
  EXPECT_FALSE(lit_crossing(light, {1.6, 0.1, 0.0}, {0.0, 0.0, 1.0}).has_value()) << "beside it";
}

TEST(GltfAreaLights, DiscsHaveTheirAreaAndTurnWithTheirNode) {
  Json disc{{"type", "disk"}, {"size", 0.8}};
  Json node{{"name", "disc"}, {"rotation", {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)}}};
  const Scene scene = load(lit_square(disc, node));
  ASSERT_EQ(scene.area_lights.size(), 1U);
  EXPECT_NEAR(area_of(scene.area_lights[0]), std::numbers::pi * 0.16, 1e-9);
  EXPECT_NEAR(scene.area_lights[0].axis.x, -1.0, 1e-7) << "a quarter turn about y takes -Z to -X";
  EXPECT_EQ(scene.area_lights[0].radiance, Rgb(1000.0)) << "the draft's default";
  disc["extras"]["aspect"] = 0.5;
  EXPECT_NEAR(area_of(load(lit_square(disc, node)).area_lights.at(0)), std::numbers::pi * 0.08, 1e-9);
}

TEST(GltfAreaLights, AreScaledAsTheLightsOfTheFileAre) {
  GltfSettings settings{.state = {.light_scale = 0.5}};
  EXPECT_EQ(load(lit_square(rectangle), settings).area_lights.at(0).radiance, Rgb(10.0, 5.0, 2.5));
  settings.state = {.units = LightUnits::photometric, .luminous_efficacy = 500.0};
  EXPECT_NEAR(load(lit_square(rectangle), settings).area_lights.at(0).radiance.r, 0.04, 1e-12);
}

TEST(GltfAreaLights, AreLampsByNodeAndGroup) {
  EXPECT_EQ(find_lamps(load(lit_square(rectangle)), LampGrouping::node).names, (std::vector<std::string>{"panel"}));
  auto grouped = lit_square(rectangle, {{"name", "panel"}, {"extras", {{"lamp", "ceiling"}}}});
  EXPECT_EQ(find_lamps(load(grouped), LampGrouping::material).names, (std::vector<std::string>{"ceiling"}));
}

TEST(GltfAreaLights, AnotherLightIsAnotherScene) {
  Json brighter = rectangle;
  brighter["intensity"] = 21.0;
  const auto hash = content_hash(load(lit_square(rectangle)));
  EXPECT_NE(content_hash(load(lit_square(brighter))), hash);
  EXPECT_NE(content_hash(load(square())), hash);
}

TEST(GltfAreaLights, WhatCannotBeIsSaidOrAnError) {
  Json light = rectangle;
  light["type"] = "sphere";
  EXPECT_THAT(error_of(lit_square(light)), HasSubstr("EXT_lights_area.lights[0]: type 'sphere' does not exist"));
  light = rectangle;
  light["intensity"] = 1e40;
  EXPECT_THAT(error_of(lit_square(light)), HasSubstr("intensity is too large"));
  light = rectangle;
  light["size"] = 1e40;
  EXPECT_THAT(error_of(lit_square(light)), HasSubstr("size is too large"));
  light = rectangle;
  light["intensity"] = -1.0;
  EXPECT_TRUE(warns(load(lit_square(light)), {"negative intensity", "panel"}));
  light = rectangle;
  light["size"] = 0.0;
  const Scene flat = load(lit_square(light));
  EXPECT_TRUE(flat.area_lights.empty());
  EXPECT_TRUE(warns(flat, {"area lights without area are left out", "panel"}));
  auto missing = lit_square(rectangle);
  missing.json["nodes"].back()["extensions"]["EXT_lights_area"]["light"] = 1;
  EXPECT_THAT(error_of(missing), HasSubstr("'light' is index 1"));
}

TEST(GltfAreaLights, HiddenNodesHaveNone) {
  auto file = lit_square(rectangle);
  file.json["nodes"].back()["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_TRUE(load(file).area_lights.empty());
}

TEST(GltfAreaLights, NoNodeOfThatNameHasASurface) {
  const Scene scene = load(lit_square(rectangle));
  try {
    find_node(scene, "panel");
    FAIL();
  } catch (const UsageError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("'panel' is an area light, which has no surface"));
  }
}

TEST(GltfAreaLights, InThePlaneOfAFaceTheyArePutBeforeIt) {
  Json node{{"name", "panel"}, {"translation", {0.0, 0.0, 0.0}}, {"rotation", {1.0, 0.0, 0.0, 0.0}}};
  const Scene scene = load(lit_square(rectangle, node));
  ASSERT_EQ(scene.area_lights.size(), 1U);
  EXPECT_GT(scene.area_lights[0].corners[0].z, 1e-6) << "half a turn about x: it shines upwards";
  EXPECT_LT(scene.area_lights[0].corners[0].z, 1e-3);
  EXPECT_TRUE(warns(scene, {"lights in the plane of a face are put before it", "panel"}));
  node["translation"] = {5.0, 0.0, 0.0};
  EXPECT_EQ(load(lit_square(rectangle, node)).area_lights.at(0).corners[0].z, 0.0) << "beside it";
}

} // namespace
} // namespace meninas::test
