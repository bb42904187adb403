// KHR_materials_diffuse_transmission as files have it.
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

constexpr const char* name = "KHR_materials_diffuse_transmission";

GltfFile with_sheet(const Json& extension, const Json& more = Json::object()) {
  auto file = square();
  Json material{
      {"name", "cloth"}, {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}, {"extensions", more}};
  material["extensions"][name] = extension;
  file.json["materials"][0] = material;
  file.json["extensionsUsed"] = {name};
  return file;
}

TEST(GltfDiffuseTransmission, AreReadAndRequired) {
  auto file = with_sheet(
      {{"diffuseTransmissionFactor", 0.25}, {"diffuseTransmissionColorFactor", {1.0, 0.5, 0.25}}});
  file.json["extensionsRequired"] = {name};
  const Scene scene = load(file);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.diffuse_transmission, 0.25);
  EXPECT_EQ(material.diffuse_transmission_color, Rgb(1.0, 0.5, 0.25));
  EXPECT_TRUE(material.double_sided) << "a sheet is there from both sides";
  EXPECT_TRUE(scene.ignored.empty());
  EXPECT_NE(content_hash(scene), content_hash(load(with_sheet(Json::object()))));
}

TEST(GltfDiffuseTransmission, AreNoneWithoutAFactor) {
  const Material material = load(with_sheet(Json::object())).materials.at(0);
  EXPECT_FALSE(is_translucent(material));
  EXPECT_FALSE(material.double_sided);
}

TEST(GltfDiffuseTransmission, FactorsAreClamped) {
  const Scene scene = load(with_sheet(
      {{"diffuseTransmissionFactor", 1.5}, {"diffuseTransmissionColorFactor", {-1.0, 2.0, 0.5}}}));
  EXPECT_EQ(scene.materials.at(0).diffuse_transmission, 1.0);
  EXPECT_EQ(scene.materials.at(0).diffuse_transmission_color, Rgb(0.0, 1.0, 0.5));
  EXPECT_TRUE(warns(scene, {"diffuse transmission was clamped", "'cloth'"}));
}

TEST(GltfDiffuseTransmission, SolidGlassAndUnlitSurfacesAreNone) {
  const Json factor{{"diffuseTransmissionFactor", 0.5}};
  const Scene solid =
      load(with_sheet(factor, {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
                               {"KHR_materials_volume", {{"thicknessFactor", 0.1}}}}));
  EXPECT_FALSE(is_translucent(solid.materials.at(0)));
  EXPECT_TRUE(warns(solid, {"diffuse transmission into solid glass is left out", "'cloth'"}));
  const Scene unlit = load(with_sheet(factor, {{"KHR_materials_unlit", Json::object()}}));
  EXPECT_FALSE(is_translucent(unlit.materials.at(0)));
}

TEST(GltfDiffuseTransmission, FactorsOfAnotherKindAreRefused) {
  EXPECT_THAT(error_of(with_sheet({{"diffuseTransmissionFactor", "much"}})),
              testing::HasSubstr("diffuseTransmissionFactor"));
}

} // namespace
} // namespace meninas::test
