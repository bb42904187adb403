// What of materials is left out, or is not there at all: nothing of it without a word.
#include "scenes/materials/texture_lookup.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gtest/gtest.h>

namespace meninas::test {

static GltfFile with_material(Json material) {
  auto file = square();
  file.json["materials"][0] = std::move(material);
  file.json["materials"][0]["name"] = "Paint";
  file.json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  file.json["images"] = Json::array({{{"uri", "data:image/png;base64,iVBORw0KGgo="}}});
  file.json["textures"] = Json::array({{{"source", 0}}});
  return file;
}

static void set_colors(GltfFile& file, float alpha) {
  square_primitive(file)["attributes"]["COLOR_0"] = file.add_accessor(
      std::vector<float>{1, 1, 1, 1, 1, 1, 1, alpha, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC4");
}

TEST(GltfWarnings, AlphaOfVerticesIsBlendedWithoutAWord) {
  for (const float alpha : {1.0F, 0.5F}) {
    auto file = with_material({{"alphaMode", "BLEND"}});
    set_colors(file, alpha);
    const Scene scene = load(file);
    EXPECT_FALSE(warns(scene, {"alpha"}));
    EXPECT_EQ(is_blended(scene.materials[0]), alpha < 1.0F);
  }
}

TEST(GltfWarnings, AThicknessTextureAsksForCoordinatesWhereItIsRead) {
  const auto asks = [](const char* absent) {
    Json volume{{"thicknessFactor", 0.5},
                {"attenuationDistance", 1.0},
                {"thicknessTexture", {{"index", 0}, {"texCoord", 1}}}};
    volume.erase(absent);
    return warns(
        load(with_material({{"extensions",
                             {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
                              {"KHR_materials_volume", volume}}}})),
        {"coordinates that their materials ask for", "'Quad'"});
  };
  EXPECT_TRUE(asks("nothing"));
  EXPECT_FALSE(asks("thicknessFactor")) << "of a pane";
  EXPECT_FALSE(asks("attenuationDistance")) << "without absorption";
  EXPECT_FALSE(asks("thicknessTexture"));
}

TEST(GltfWarnings, NothingIsLeftBelowACutoffAboveOne) {
  const auto is_left = [](double cutoff) {
    const Scene scene = load(with_material({{"alphaMode", "MASK"}, {"alphaCutoff", cutoff}}));
    const Material& material = scene.materials.at(0);
    return !is_cut_out(material, untextured(material));
  };
  EXPECT_TRUE(is_left(-1.0));
  EXPECT_TRUE(is_left(1.0));
  EXPECT_FALSE(is_left(1.5));
}

} // namespace meninas::test
