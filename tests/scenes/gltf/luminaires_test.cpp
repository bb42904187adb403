// EXT_lights_ies, IES files in place of lights, and files whose light is photometric.
#include "scenes/ies/intensity_distribution.h"
#include "scenes/punctual_light.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

using testing::HasSubstr;

/// 683 cd where it aims, half of that at 60 degrees, dark from 90 on; quarters differ: 1 at 0, 3 at 90.
const std::string profile = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 683 2 2 1 2 0 0 0\n1 1 1\n0 90\n0 90\n1 0\n3 0\n";

std::string uri_of(const std::string& text) { return data_uri(Bytes(text.begin(), text.end())); }

/// The square below a luminaire at (0, 0, 2) that has these properties and this node's turn.
GltfFile lit_square(const Json& use, const std::string& ies = profile) {
  auto file = square();
  file.json["extensions"]["EXT_lights_ies"]["lights"] = Json::array({{{"uri", uri_of(ies)}}});
  file.json["extensionsUsed"] = {"EXT_lights_ies"};
  Json node{{"name", "spot"}, {"translation", {0.0, 0.0, 2.0}}};
  node["extensions"]["EXT_lights_ies"] = use;
  file.add_node(node);
  return file;
}

Rgb irradiance_at(const Scene& scene, const Point3& x) {
  return punctual_sample(scene.lights.at(0), x, 100.0).irradiance;
}

TEST(GltfLuminaires, CandelaOfTheFileTimesMultiplierAndColour) {
  const Scene scene = load(lit_square({{"light", 0}, {"multiplier", 2.0}, {"color", {1.0, 0.5, 0.0}}}));
  EXPECT_TRUE(scene.ignored.empty());
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].name, "spot");
  // 683 cd are 1 W/sr; -Z is down: at two metres a quarter, times 2 and the colour. The 3 of the
  // horizontal angle 90 is the same direction.
  const Rgb below = irradiance_at(scene, {0.0, 0.0, 0.0});
  EXPECT_NEAR(below.r, 0.5, 1e-12);
  EXPECT_NEAR(below.g, 0.25, 1e-12);
  EXPECT_EQ(below.b, 0.0);
}

TEST(GltfLuminaires, FollowTheirNode) {
  // A quarter turn about y takes -Z to -X; x of the luminaire, where horizontal angles begin, to -Z.
  auto file = lit_square({{"light", 0}});
  auto& node = file.json["nodes"].back();
  node["rotation"] = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  node["scale"] = {3.0, 3.0, 3.0};
  const Scene scene = load(file);
  // 45 degrees from the axis: towards the world's -Z 0.5 W/sr, towards its Y thrice that; 2 m^2 away.
  EXPECT_NEAR(irradiance_at(scene, {-1.0, 0.0, 1.0}).g, 0.25, 1e-7);
  EXPECT_NEAR(irradiance_at(scene, {-1.0, 1.0, 2.0}).g, 0.75, 1e-7);
  EXPECT_EQ(irradiance_at(scene, {1.0, 0.0, 2.0}), Rgb(0.0));
}

TEST(GltfLuminaires, AlsoFromBufferViewsAndFiles) {
  const Scene by_uri = load(lit_square({{"light", 0}}));
  auto file = lit_square({{"light", 0}});
  const auto view = file.add_view(Bytes(profile.begin(), profile.end()));
  file.json["extensions"]["EXT_lights_ies"]["lights"][0] = {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}};
  EXPECT_EQ(load(file).lights.at(0).distribution->candela, by_uri.lights.at(0).distribution->candela);
  EXPECT_EQ(content_hash(load(file)), content_hash(by_uri));

  const TemporaryFolder folder;
  folder.write("lamp.ies", profile);
  file.json["extensions"]["EXT_lights_ies"]["lights"][0] = {{"uri", "lamp.ies"}};
  const auto saved = folder.write("room.gltf", as_text(file));
  EXPECT_EQ(load_gltf(saved, {}).lights.at(0).distribution->candela, by_uri.lights.at(0).distribution->candela);
}

TEST(GltfLuminaires, AnotherDistributionIsAnotherScene) {
  std::string other = profile;
  other[other.rfind("3 0")] = '4';
  EXPECT_NE(content_hash(load(lit_square({{"light", 0}}))), content_hash(load(lit_square({{"light", 0}}, other))));
}

TEST(GltfLuminaires, BadOnesAreOneLineWithTheLinesNumber) {
  EXPECT_THAT(error_of(lit_square({{"light", 0}}, "IESNA91\nTILT=NONE\n1 1 x\n")),
              HasSubstr("EXT_lights_ies.lights[0], line 3: the candela multiplier is no number"));
  EXPECT_THAT(error_of(lit_square({{"light", 1}})), HasSubstr("'light' is index 1"));
  auto file = lit_square({{"light", 0}});
  file.json["extensions"]["EXT_lights_ies"]["lights"][0] = {{"name", "none"}};
  EXPECT_THAT(error_of(file), HasSubstr("EXT_lights_ies.lights[0]: neither uri nor bufferView"));
  file.json["extensions"]["EXT_lights_ies"]["lights"][0] = {{"uri", "missing.ies"}};
  EXPECT_THAT(error_of(file), HasSubstr("'missing.ies': no such file"));
}

TEST(GltfLuminaires, TakeThePlaceOfALight) {
  auto file = square();
  file.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"}, {"color", {0.5, 1.0, 1.0}}, {"intensity", 700.0}}, {{"type", "directional"}}});
  for (const int light : {0, 1}) {
    Json node{{"name", light == 0 ? "desk lamp" : "sun"}, {"translation", {0.0, 0.0, 2.0}}};
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    file.add_node(node);
  }
  const TemporaryFolder folder;
  const std::string ies = folder.write("lamp.ies", profile).string();
  const auto settings = [&](const std::string& light, const std::string& lamp) {
    return GltfSettings{.state = {.luminaires = {{light, lamp}}}};
  };
  const Scene scene = load(file, settings("desk lamp", ies));
  EXPECT_EQ(scene.lights.at(0).kind, PunctualKind::point);
  EXPECT_NEAR(irradiance_at(scene, {0.0, 0.0, 0.0}).g, 0.25, 1e-12) << "the file's candela, not the scene's";
  EXPECT_NEAR(irradiance_at(scene, {0.0, 0.0, 0.0}).r, 0.125, 1e-12) << "in the light's colour";
  EXPECT_TRUE(warns(scene, {"IES files say how bright lights are", "'desk lamp, "}));
  EXPECT_THAT(error_of(file, settings("desk lmap", ies)), HasSubstr("--ies: no light 'desk lmap', did you mean 'desk lamp'?"));
  EXPECT_THAT(error_of(file, settings("sun", ies)), HasSubstr("light 'sun' is directional"));
  auto flat = file;
  flat.json["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "point"}};
  flat.json["nodes"][flat.json["nodes"].size() - 2]["scale"] = {0.0, 0.0, 0.0};
  EXPECT_THAT(error_of(flat, settings("desk lamp", ies)), HasSubstr("--ies: the node of light 'desk lamp' is scaled to nothing"));
  const std::string bad = folder.write("bad.ies", "IESNA91\nTILT=NONE\n").string();
  EXPECT_THAT(error_of(file, settings("desk lamp", bad)), HasSubstr("bad.ies: line 3: the file ends before"));
}

// cd, cd/m^2 and lux by 500 lm/W.
TEST(GltfUnits, PhotometricNumbersAreDividedByTheEfficacy) {
  auto file = lit_square({{"light", 0}});
  file.json["materials"][0]["emissiveFactor"] = {1.0, 1.0, 0.5};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}, {"intensity", 250.0}}});
  Json node{{"name", "bulb"}};
  node["translation"] = {0.0, 0.0, 1.0};
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.add_node(node);
  const SceneState photometric{.units = LightUnits::photometric, .luminous_efficacy = 500.0};
  const Scene scene = load(file, {.state = photometric});
  EXPECT_NEAR(scene.materials.at(0).emission.r, 0.002, 1e-15);
  EXPECT_NEAR(scene.materials.at(0).emission.b, 0.001, 1e-15);
  EXPECT_NEAR(scene.lights.at(1).intensity.g, 0.5, 1e-12);
  EXPECT_NEAR(irradiance_at(scene, {0.0, 0.0, 0.0}).g, 683.0 / 500.0 / 4.0, 1e-12) << "candela whatever the units";
  const Scene radiometric = load(file, {.state = {.luminous_efficacy = 500.0}});
  EXPECT_EQ(radiometric.materials.at(0).emission.r, 1.0);
  EXPECT_EQ(radiometric.lights.at(1).intensity.g, 250.0);
  EXPECT_NEAR(irradiance_at(radiometric, {0.0, 0.0, 0.0}).g, 683.0 / 500.0 / 4.0, 1e-12);
}

TEST(GltfUnits, AsTheFileSaysUnlessTheUserDoes) {
  auto file = square();
  file.json["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
  const auto emission = [&](const SceneState& state) { return load(file, {.state = state}).materials.at(0).emission.g; };
  file.json["asset"]["extras"]["light_units"] = "photometric";
  EXPECT_DOUBLE_EQ(emission({}), 1.0 / 683.0);
  EXPECT_TRUE(warns(load(file), {"light is in cd/m^2, cd and lx, as asset.extras.light_units says"}));
  EXPECT_EQ(emission({.units = LightUnits::radiometric}), 1.0);
  EXPECT_TRUE(load(file, {.state = {.units = LightUnits::radiometric}}).warnings.empty());
  file.json["asset"]["extras"]["light_units"] = "radiometric";
  EXPECT_EQ(emission({}), 1.0);
  EXPECT_TRUE(load(file).warnings.empty());
  EXPECT_DOUBLE_EQ(emission({.units = LightUnits::photometric}), 1.0 / 683.0);
  for (const Json& odd : {Json("lumens"), Json(3), Json::object()}) {
    file.json["asset"]["extras"]["light_units"] = odd;
    EXPECT_EQ(emission({}), 1.0);
    EXPECT_TRUE(warns(load(file), {"asset.extras.light_units is neither"}));
  }
  // Long words are cut between characters: 99 bytes and then one of two.
  file.json["asset"]["extras"]["light_units"] = std::string(99, 'x') + "\u00e4ndern";
  EXPECT_TRUE(warns(load(file), {std::string(99, 'x') + "...'"}));
  file.json["asset"]["extras"] = "photometric";
  EXPECT_EQ(emission({}), 1.0);
}

} // namespace
} // namespace meninas::test
