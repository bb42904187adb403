// Alpha of BLEND as the loader reads it: coverage.
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

GltfFile with_material(Json material) {
  auto file = square();
  file.json["materials"][0] = std::move(material);
  return file;
}

/// A square of this alpha, blended, that glows.
GltfFile veil(double alpha, const Json& extensions = Json::object()) {
  return with_material(
      {{"name", "Veil"},
       {"alphaMode", "BLEND"},
       {"emissiveFactor", {1.0, 1.0, 1.0}},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}, {"metallicFactor", 0}}},
       {"extensions", extensions}});
}

TEST(GltfAlpha, AlphaOfBlendIsCoverage) {
  const auto scene = load(veil(0.25));
  EXPECT_TRUE(is_blended(scene.materials[0]));
  EXPECT_EQ(scene.materials[0].transmission, 0.75);
  EXPECT_EQ(scene.materials[0].emission, Rgb(0.25)) << "of what is not there nothing glows";
  EXPECT_TRUE(scene.materials[0].double_sided);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_FALSE(is_glass(load(veil(1.0)).materials[0]));
}

TEST(GltfAlpha, SurfacesOfAlphaZeroAreNotThere) {
  EXPECT_THAT(error_of(veil(0.0)), testing::HasSubstr("all surfaces have alpha 0"));
  auto file = veil(0.0);
  file.add_material({{"name", "Wall"}});
  Json wall = square_primitive(file);
  wall["material"] = 1;
  file.add_node({{"name", "Wall"}, {"mesh", file.add_mesh(Json::array({wall}))}});
  const auto scene = load(file);
  EXPECT_EQ(scene.triangles.size(), 2U);
  EXPECT_TRUE(warns(scene, {"alpha 0", "'Quad'"}));
}

TEST(GltfAlpha, GlassIsNotBlendedBesides) {
  const auto scene =
      load(veil(0.25, {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}}));
  EXPECT_FALSE(is_blended(scene.materials[0]));
  EXPECT_TRUE(is_glass(scene.materials[0]));
  EXPECT_TRUE(warns(scene, {"alpha of glass", "'Veil'"}));
}

} // namespace
} // namespace meninas::test
