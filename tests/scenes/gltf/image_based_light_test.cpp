// EXT_lights_image_based: what of it is read, and where the faces of its cube are.
#include "scenes/sky/cube_faces.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

using testing::IsEmpty;

/// The square under a cube of six images, face k the one byte 10 + k.
GltfFile under_cube() {
  auto file = square();
  Json faces = Json::array();
  for (unsigned char k = 0; k < 6; ++k) {
    const std::size_t view = file.add_view({static_cast<unsigned char>(10 + k)});
    file.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
    faces.push_back(k);
  }
  file.json["extensionsUsed"] = {"EXT_lights_image_based"};
  file.json["extensions"]["EXT_lights_image_based"]["lights"] =
      Json::array({{{"name", "studio"},
                    {"intensity", 2.5},
                    {"rotation", {0.0, 0.6, 0.0, 0.8}},
                    {"specularImageSize", 1},
                    {"specularImages", Json::array({faces})}}});
  file.json["scenes"] = Json::array({{{"nodes", {0}}}});
  file.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  file.json["scene"] = 0;
  return file;
}

TEST(ImageBasedLights, AreReadAsTheyAreEncoded) {
  const Scene scene = load(under_cube());
  ASSERT_TRUE(scene.background.encoded);
  EXPECT_EQ(scene.background.encoded->name, "studio");
  EXPECT_EQ(scene.background.encoded->intensity, 2.5);
  EXPECT_EQ(scene.background.encoded->rotation, (std::array{0.0, 0.6, 0.0, 0.8}));
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_EQ(std::to_integer<std::size_t>(scene.background.encoded->faces[k].at(0)), 10 + k);
  EXPECT_THAT(scene.ignored, IsEmpty());
  EXPECT_NE(content_hash(scene), content_hash(load(square())));
}

TEST(ImageBasedLights, WhatCannotBeUsedIsNamedAndLeftOut) {
  auto five = under_cube();
  five.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0].erase(0);
  EXPECT_TRUE(warns(load(five), {"EXT_lights_image_based is left out", "not six images"}));
  auto words = under_cube();
  words.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"] = "cube";
  EXPECT_TRUE(warns(load(words), {"EXT_lights_image_based is left out"}));
  auto beyond = under_cube();
  beyond.json["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"][0][3] = 99;
  EXPECT_TRUE(warns(load(beyond), {"EXT_lights_image_based is left out"}));
  EXPECT_FALSE(load(beyond).background.encoded);
  auto no_light = under_cube();
  no_light.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
  EXPECT_NE(error_of(no_light), "no error");
  auto none_chosen = under_cube();
  none_chosen.json["scenes"][0].erase("extensions");
  EXPECT_FALSE(load(none_chosen).background.encoded);
}

ImageBasedLight plain_cube() {
  ImageBasedLight light;
  light.name = "cube";
  for (std::size_t k = 0; k < 6; ++k)
    light.faces[k].push_back(static_cast<std::byte>(k));
  return light;
}

/// Face k is k + 1 in red, brighter to its right in green and downwards in blue, alpha as given.
DecodeFace painted(int size, float alpha) {
  return [=](std::span<const std::byte> encoded, const std::string&) {
    TexturePixels face{size, size, {}};
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        face.texels.emplace_back(1.0F + static_cast<float>(std::to_integer<int>(encoded[0])), (float(x) + 0.5F) / float(size),
                                 (float(y) + 0.5F) / float(size), alpha);
    return face;
  };
}

TEST(ImageBasedLights, FacesAreWhereTheExtensionPutsThem) {
  std::vector<std::string> warnings;
  const RadianceMap map = map_of_cube(plain_cube(), painted(64, 1.0F), warnings);
  EXPECT_THAT(warnings, IsEmpty());
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(radiance_from(map, axes[k] + Vec3(0.01, 0.01, 0.01), Suns::shown).r, k + 1.0, 1e-4);
  // From inside, right of +X is +Z, and down is -Y; above, right of +Y is -X, and down +Z.
  const glm::vec3 x = radiance_from(map, {1.0, 0.4, 0.6}, Suns::shown);
  EXPECT_NEAR(x.g, 0.8, 0.01);
  EXPECT_NEAR(x.b, 0.3, 0.01);
  const glm::vec3 y = radiance_from(map, {-0.6, 1.0, -0.4}, Suns::shown);
  EXPECT_NEAR(y.g, 0.8, 0.01);
  EXPECT_NEAR(y.b, 0.3, 0.01);
}

TEST(ImageBasedLights, RgbdIsDividedByAlphaAndMultipliedByIntensity) {
  ImageBasedLight light = plain_cube();
  light.intensity = 3.0;
  std::vector<std::string> warnings;
  const RadianceMap map = map_of_cube(light, painted(16, 0.25F), warnings);
  EXPECT_NEAR(radiance_from(map, {1.0, 0.01, 0.01}, Suns::shown).r, 12.0, 1e-3);
}

TEST(ImageBasedLights, RotationTurnsTheCube) {
  ImageBasedLight light = plain_cube();
  // A quarter about +Y takes +X to -Z.
  light.rotation = {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  std::vector<std::string> warnings;
  const RadianceMap map = map_of_cube(light, painted(16, 1.0F), warnings);
  EXPECT_NEAR(radiance_from(map, {0.01, 0.01, -1.0}, Suns::shown).r, 1.0, 1e-3);
  EXPECT_NEAR(radiance_from(map, {1.0, 0.01, 0.01}, Suns::shown).r, 5.0, 1e-3);
}

TEST(ImageBasedLights, FacesOfDifferentSizesAreLeftOutByName) {
  Environment sky;
  sky.encoded = std::make_shared<const ImageBasedLight>(plain_cube());
  std::vector<std::string> warnings;
  settle_environment(
      sky,
      [](std::span<const std::byte> encoded, const std::string& name) {
        return painted(4 + std::to_integer<int>(encoded[0]), 1.0F)(encoded, name);
      },
      warnings);
  EXPECT_TRUE(is_dark(sky));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0], "EXT_lights_image_based is left out: cube: its faces are no squares of one size");
}

} // namespace
} // namespace meninas::test
