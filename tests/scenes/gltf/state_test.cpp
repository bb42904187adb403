// Hidden nodes, coarser levels of detail, variants of materials, the scale of lights.
#include "tests/scenes/gltf/gltf_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things)
    names.push_back(thing.name);
  return names;
}

Json with_light(Json node) {
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return node;
}

/// Quad; Space (Cupboard (Bulb with a light and a camera), Shelf), meshes but for Bulb.
GltfFile furnished() {
  auto file = square();
  file.json["cameras"] =
      Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}}}}});
  file.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "point"}, {"intensity", 2.0}}});
  file.add_node({{"name", "Space"}, {"mesh", 0}, {"children", {2, 4}}});
  file.add_node({{"name", "Cupboard"}, {"mesh", 0}, {"children", {3}}});
  file.add_node(with_light({{"name", "Bulb"}, {"camera", 0}, {"translation", {0, 0, 1}}}));
  file.add_node({{"name", "Shelf"}, {"mesh", 0}});
  return file;
}

void set_visible(GltfFile& file, std::size_t node, bool visible) {
  file.json["nodes"][node]["extensions"]["KHR_node_visibility"]["visible"] = visible;
}

TEST(GltfVisibility, HiddenNodesHideMeshesAndLightsBelowThem) {
  auto file = furnished();
  set_visible(file, 2, false);
  set_visible(file, 3, true); // its parent has it hidden all the same
  const Scene scene = load(file);
  EXPECT_THAT(names_of(scene.nodes), ElementsAre("Quad", "Space", "Shelf"));
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_THAT(names_of(scene.cameras), ElementsAre("Bulb")) << "a camera is nothing to see";
  EXPECT_TRUE(warns(scene, {"hides meshes and lights", "'Cupboard'", "'Bulb'"}));
  EXPECT_TRUE(scene.ignored.empty());
  set_visible(file, 1, false);
  EXPECT_THAT(names_of(load(file).nodes), ElementsAre("Quad"));
}

TEST(GltfVisibility, WhatIsVisibleIsAsWithoutTheExtension) {
  auto file = furnished();
  const Scene before = load(file);
  set_visible(file, 1, true);
  file.json["nodes"][2]["extensions"]["KHR_node_visibility"] = Json::object();
  file.json["extensionsRequired"] = {"KHR_node_visibility"};
  const Scene after = load(file);
  EXPECT_EQ(content_hash(after), content_hash(before));
  EXPECT_EQ(after.lights.size(), 1U);
  EXPECT_EQ(after.warnings, before.warnings);
  file.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = "no";
  EXPECT_THAT(error_of(file), HasSubstr("'visible' must be true or false"));
}

TEST(GltfVisibility, JointsOfHiddenNodesStillMoveTheirSkins) {
  auto file = skinned_square();
  set_visible(file, 1, false);
  EXPECT_EQ(load(file).vertices.at(0).position, Point3(1, 2, 0));
}

TEST(GltfLevelsOfDetail, TheNodeIsTheFinestAndOthersAreNotShown) {
  auto file = furnished();
  file.json["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {4, 0};
  const Scene scene = load(file);
  EXPECT_THAT(names_of(scene.nodes), ElementsAre("Space", "Cupboard"));
  EXPECT_TRUE(warns(scene, {"coarser levels of detail", "'Space'"}));
  EXPECT_TRUE(scene.ignored.empty());
  file.json["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {9};
  EXPECT_THAT(error_of(file), HasSubstr("'ids' is index 9 of nodes, there are 5"));
}

TEST(GltfLevelsOfDetail, NodesThatListEachOtherOrThemselvesLeaveOne) {
  auto file = furnished();
  file.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {0, 4};
  file.json["nodes"][4]["extensions"]["MSFT_lod"]["ids"] = {0};
  EXPECT_THAT(names_of(load(file).nodes), ElementsAre("Quad", "Space", "Cupboard"));
}

/// The square in grey; red by day, blue by night and in winter.
GltfFile with_variants() {
  auto file = square();
  for (const char* name : {"red", "blue"})
    file.add_material({{"name", name}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}});
  file.json["extensions"]["KHR_materials_variants"]["variants"] = Json::array(
      {{{"name", "day"}}, {{"name", "night"}}, {{"name", "winter"}}, {{"name", "plain"}}});
  square_primitive(file)["extensions"]["KHR_materials_variants"]["mappings"] = Json::array(
      {{{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {1, 2}}}});
  return file;
}

TEST(GltfVariants, ChooseTheMaterialsOfTheirMappings) {
  const auto material_by = [](std::optional<std::string> variant) {
    const Scene scene = load(with_variants(), {.state = {.variant = std::move(variant)}});
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_THAT(scene.variants, ElementsAre("day", "night", "winter", "plain"));
    EXPECT_TRUE(scene.ignored.empty());
    return scene.materials.at(0).name;
  };
  EXPECT_EQ(material_by(std::nullopt), "grey");
  EXPECT_EQ(material_by("day"), "red");
  EXPECT_EQ(material_by("night"), "blue");
  EXPECT_EQ(material_by("winter"), "blue");
  EXPECT_EQ(material_by("plain"), "grey") << "no mapping has it";
}

TEST(GltfVariants, UnknownNamesGetTheNearest) {
  const auto refusal = [](const GltfFile& file, const char* name) {
    return error_of(file, {.state = {.variant = name}});
  };
  EXPECT_THAT(refusal(with_variants(), "nihgt"), HasSubstr("no variant 'nihgt', did you mean 'night'?"));
  EXPECT_THAT(refusal(with_variants(), "summer time"),
              HasSubstr("no variant 'summer time' among 4 variants such as 'day'"));
  EXPECT_THAT(refusal(square(), "day"), HasSubstr("no variant 'day', the scene has no variants"));
}

TEST(GltfVariants, MappingsAreChecked) {
  const std::pair<const char*, const char*> edits[] = {
      {"/material", "'material' is index 9 of materials, there are 3"},
      {"/variants/0", "'variants' is index 9 of variants, there are 4"}};
  for (const auto& [pointer, line] : edits) {
    auto file = with_variants();
    auto& mapping =
        square_primitive(file)["extensions"]["KHR_materials_variants"]["mappings"][0];
    mapping[Json::json_pointer(pointer)] = 9;
    EXPECT_THAT(error_of(file), HasSubstr(line));
  }
}

TEST(GltfLights, AreScaledAndNothingElse) {
  auto file = furnished();
  file.json["materials"][0]["emissiveFactor"] = {1.0, 1.0, 1.0};
  const Scene scene = load(file, {.state = {.light_scale = 0.25}});
  EXPECT_EQ(scene.lights.at(0).intensity, Rgb(0.5));
  EXPECT_EQ(scene.materials.at(0).emission, Rgb(1.0));
}

} // namespace
} // namespace meninas::test
