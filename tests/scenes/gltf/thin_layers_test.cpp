// Sheen, iridescence, anisotropy, dispersion: what is read of them, and what the user is told.
#include "scenes/errors.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

/// A material with an extension; `model` is its pbrMetallicRoughness.
Scene with_extension(const std::string& name, const Json& extension,
                     const Json& model = {{"metallicFactor", 0.0}}, const Json& more = Json::object()) {
  auto file = square();
  Json material{{"name", "cloth"}, {"pbrMetallicRoughness", model}, {"extensions", more}};
  material["extensions"][name] = extension;
  file.json["materials"][0] = material;
  file.json["extensionsUsed"] = {name};
  return load(file);
}

TEST(GltfThinLayers, ReadSheen) {
  const Scene scene = with_extension("KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 2.0}},
                                                             {"sheenRoughnessFactor", 0.7}});
  EXPECT_EQ(scene.materials.at(0).sheen_color, Rgb(0.5, 0.25, 1.0));
  EXPECT_EQ(scene.materials.at(0).sheen_roughness, 0.7);
  EXPECT_TRUE(warns(scene, {"sheen colours were clamped", "'cloth'"}));
  EXPECT_TRUE(scene.ignored.empty());
  EXPECT_NE(content_hash(scene), content_hash(with_extension("KHR_materials_sheen", Json::object())));
}

TEST(GltfThinLayers, SheenIsOfWhatIsOpaque) {
  const Scene scene = with_extension(
      "KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}}, {{"metallicFactor", 0.0}},
      {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}});
  EXPECT_EQ(scene.materials.at(0).sheen_color, Rgb(0.0));
  EXPECT_TRUE(warns(scene, {"sheen of what light passes is left out", "'cloth'"}));
}

TEST(GltfThinLayers, ReadIridescence) {
  const Json film{{"iridescenceFactor", 0.5}, {"iridescenceIor", 1.4},
                  {"iridescenceThicknessMaximum", 300.0}};
  const Scene metal = with_extension("KHR_materials_iridescence", film,
                                     {{"baseColorFactor", {0.5, 0.6, 0.7, 1.0}},
                                      {"metallicFactor", 1.0}, {"roughnessFactor", 0.2}});
  const Material& material = metal.materials.at(0);
  EXPECT_EQ(material.base_color, Rgb(0.5, 0.6, 0.7)) << "what is below keeps its colour";
  EXPECT_EQ(film_of(material), (ThinFilm{1.4, 300.0, 0.5}));
  EXPECT_TRUE(metal.warnings.empty());
  EXPECT_TRUE(metal.ignored.empty());
  const Scene none = with_extension("KHR_materials_iridescence", Json::object(),
                                    {{"baseColorFactor", {0.5, 0.6, 0.7, 1.0}},
                                     {"metallicFactor", 1.0}, {"roughnessFactor", 0.2}});
  EXPECT_EQ(none.materials.at(0).iridescence, 0.0);
  EXPECT_NE(content_hash(metal), content_hash(none));
}

TEST(GltfThinLayers, IridescenceOutOfRangeIsClampedAndOfWhatIsMattLeftOut) {
  const Json model{{"metallicFactor", 1.0}};
  const Scene wild = with_extension("KHR_materials_iridescence",
                                    {{"iridescenceFactor", 2.0}, {"iridescenceIor", 0.2},
                                     {"iridescenceThicknessMaximum", -5.0}},
                                    model);
  EXPECT_EQ(film_of(wild.materials.at(0)), (ThinFilm{1.0, 0.0, 1.0}));
  EXPECT_TRUE(warns(wild, {"factors of iridescence out of range were clamped", "'cloth'"}));
  const Scene matt = with_extension("KHR_materials_iridescence", {{"iridescenceFactor", 1.0}},
                                    {{"metallicFactor", 0.0}, {"roughnessFactor", 0.9}});
  EXPECT_EQ(matt.materials.at(0).iridescence, 0.0);
  EXPECT_TRUE(warns(matt, {"iridescence of what is matt is left out", "'cloth'"}));
}

TEST(GltfThinLayers, ReadTheTexturesOfIridescence) {
  auto file = square();
  const auto image = file.add_view(Bytes(8, 1));
  file.json["images"] = Json::array({{{"bufferView", image}, {"mimeType", "image/png"}}});
  // A texture that nothing uses comes first: the scene's numbers are not the file's.
  file.json["textures"] = Json::array({{{"source", 0}}, {{"source", 0}, {"name", "film"}}});
  file.json["materials"][0] = {
      {"name", "shell"},
      {"pbrMetallicRoughness", {{"metallicFactor", 1.0}}},
      {"extensions",
       {{"KHR_materials_iridescence",
         {{"iridescenceFactor", 1.0},
          {"iridescenceTexture", {{"index", 1}}},
          {"iridescenceThicknessTexture", {{"index", 1}, {"texCoord", 1}}}}}}}};
  const Scene scene = load(file);
  ASSERT_TRUE(scene.materials.at(0).iridescence_texture);
  ASSERT_TRUE(scene.materials.at(0).film_thickness_texture);
  EXPECT_EQ(scene.materials.at(0).film_thickness_texture->texcoord_set, 1);
  EXPECT_EQ(film_of(scene.materials.at(0)).thickness, 250.0) << "the mean of the bounds";
  ASSERT_EQ(scene.textures.size(), 1U);
  EXPECT_EQ(scene.materials.at(0).iridescence_texture->texture, TextureId{0});
  EXPECT_TRUE(warns(scene, {"texture coordinates that their materials ask for are missing"}));
  file.json["materials"][0]["extensions"]["KHR_materials_iridescence"]["iridescenceTexture"] = 3;
  EXPECT_THROW(load(file), InputError);
}

TEST(GltfThinLayers, ReadAnisotropy) {
  const Json model{{"metallicFactor", 1.0}, {"roughnessFactor", 0.4}};
  const Scene scene = with_extension(
      "KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.0}}, model);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.roughness, 0.4);
  EXPECT_EQ(material.anisotropy, 0.5);
  EXPECT_EQ(material.anisotropy_direction, Vec2(std::cos(1.0), std::sin(1.0)));
  EXPECT_TRUE(scene.ignored.empty());
  const Scene none = with_extension("KHR_materials_anisotropy", {{"anisotropyRotation", 1.0}}, model);
  EXPECT_EQ(none.materials.at(0).anisotropy, 0.0);
  EXPECT_TRUE(none.warnings.empty());
  EXPECT_TRUE(none.tangents.empty());
  EXPECT_NE(content_hash(scene), content_hash(none));
  const Scene strong = with_extension("KHR_materials_anisotropy", {{"anisotropyStrength", 1.5}}, model);
  EXPECT_EQ(strong.materials.at(0).anisotropy, 1.0);
  EXPECT_TRUE(warns(strong, {"strengths of anisotropy were clamped", "'cloth'"}));
}

TEST(GltfThinLayers, ReadTheTextureOfAnisotropy) {
  auto file = square();
  const auto image = file.add_view(Bytes(8, 1));
  file.json["images"] = Json::array({{{"bufferView", image}, {"mimeType", "image/png"}}});
  file.json["textures"] = Json::array({{{"source", 0}}});
  file.json["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {
      {"anisotropyStrength", 0.5}, {"anisotropyTexture", {{"index", 0}, {"texCoord", 1}}}};
  const Scene scene = load(file);
  ASSERT_TRUE(scene.materials.at(0).anisotropy_texture);
  EXPECT_EQ(scene.materials.at(0).anisotropy_texture->texcoord_set, 1);
  EXPECT_TRUE(warns(scene, {"texture coordinates that their materials ask for are missing"}));
  file.json["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 0.0;
  EXPECT_FALSE(load(file).materials.at(0).anisotropy_texture) << "nothing to be told";
}

TEST(GltfThinLayers, DispersionIsNamedWhereThereIsGlass) {
  const Json glass{{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}};
  EXPECT_TRUE(warns(with_extension("KHR_materials_dispersion", {{"dispersion", 0.2}},
                                   {{"metallicFactor", 0.0}}, glass),
                    {"dispersion is left out, all colours are refracted by the ior", "'cloth'"}));
  EXPECT_TRUE(with_extension("KHR_materials_dispersion", {{"dispersion", 0.2}}).warnings.empty())
      << "there is nothing to refract";
}

} // namespace
} // namespace meninas::test
