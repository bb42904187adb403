// Textures that say the same wherever they are shown become factors; others stay.
#include "scenes/materials/constant_textures.h"
#include "scenes/material.h"
#include "scenes/materials/texel_ranges.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meninas::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

glm::vec4 codes(float r, float g, float b, float a = 255.0F) {
  return glm::vec4(r, g, b, a) / 255.0F;
}

TexturePixels filled(int width, int height, const glm::vec4& texel) {
  return {width, height,
          std::vector<glm::vec4>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                 texel)};
}

glm::vec4& texel(TexturePixels& image, int x, int y) {
  return image.texels[static_cast<std::size_t>(y) * image.width + x];
}

/// A square metre that shows the rectangle of the image between two corners.
void add_square(Scene& scene, const std::string& name, const Material& material, glm::vec2 low,
                glm::vec2 high, double x = 0.0) {
  const auto first = scene.vertices.size();
  add_polygon(scene, name, {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}}, material);
  for (auto v = first; v < scene.vertices.size(); ++v) {
    const auto& at = scene.vertices[v].position;
    own_attributes(scene, scene.vertices[v]).texcoord[0] =
        low + glm::vec2(at.x - x, at.y) * (high - low);
  }
  // Quads built by hand have a material each; the tests speak of one.
  for (Triangle& triangle : scene.triangles)
    triangle.material = MaterialId{0};
}

Material rough_metal() {
  Material material;
  material.base_color = Rgb(0.9);
  material.metallic = 1.0;
  material.roughness = 1.0;
  material.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  return material;
}

/// With one image in all slots; returns what is said.
std::vector<std::string> fold(Scene& scene, const TexturePixels& image) {
  DecodedTextures textures = decode_textures(
      scene, [&](const Texture&, TextureContent) { return image; });
  return fold_constant_textures(scene, textures);
}

Scene& folded(Scene& scene, const TexturePixels& image) {
  fold(scene, image);
  return scene;
}

Scene square(const Material& material, glm::vec2 low = {0, 0}, glm::vec2 high = {1, 1}) {
  Scene scene;
  scene.textures = {{.name = "t", .encoded = {}}};
  add_square(scene, "square", material, low, high);
  return scene;
}

TEST(ConstantTextures, AreFactors) {
  Material material = rough_metal();
  material.base_color_texture = material.emissive_texture = material.metallic_roughness_texture;
  material.emission = Rgb(2.0);
  Scene scene = square(material);
  folded(scene, filled(20, 30, glm::vec4(0.25, 0.5, 0.75, 1.0)));
  const Material& result = scene.materials[0];
  EXPECT_FALSE(is_textured(result));
  EXPECT_DOUBLE_EQ(result.roughness, 0.5);
  EXPECT_DOUBLE_EQ(result.metallic, 0.75);
  EXPECT_DOUBLE_EQ(result.base_color.b, 0.9 * 0.75);
  EXPECT_DOUBLE_EQ(result.emission.r, 0.5);
}

/// Matt paint, named, with textures of all that is in its coat.
Material lacquered_paint() {
  Material material;
  material.name = "car";
  material.roughness = 0.5;
  material.specular_color = Rgb(0.8);
  material.specular_texture = material.specular_color_texture = TextureUse{.texture = TextureId{0}};
  return material;
}

TEST(ConstantTextures, OfSpecularReflectionAreFactors) {
  Scene scene = square(lacquered_paint());
  EXPECT_THAT(fold(scene, filled(8, 8, glm::vec4(0.5, 0.25, 1.0, 0.75))), IsEmpty());
  const Material& result = scene.materials[0];
  EXPECT_DOUBLE_EQ(result.specular, 0.75);
  EXPECT_DOUBLE_EQ(result.specular_color.r, 0.8 * 0.5);
  EXPECT_DOUBLE_EQ(result.specular_color.g, 0.8 * 0.25);
  EXPECT_FALSE(result.specular_texture || result.specular_color_texture);

  TexturePixels image = filled(8, 8, glm::vec4(1.0F));
  texel(image, 3, 3) = glm::vec4(0.0F);
  Scene varied = square(lacquered_paint());
  EXPECT_THAT(fold(varied, image),
              ElementsAre(AllOf(HasSubstr("specular reflection that vary are left out"),
                                HasSubstr("'car'"))));
  EXPECT_EQ(varied.materials[0].specular, 1.0);
  EXPECT_FALSE(varied.materials[0].specular_texture);
}

// As exporters write it: the factors are 1, and the image says what the lacquer is.
TEST(ConstantTextures, OfClearCoatsAreFactors) {
  Material material = lacquered_paint();
  material.specular_texture = material.specular_color_texture = std::nullopt;
  material.clear_coat = material.clear_coat_roughness = 1.0;
  material.clear_coat_texture = material.clear_coat_roughness_texture =
      TextureUse{.texture = TextureId{0}};
  Scene scene = square(material);
  EXPECT_THAT(fold(scene, filled(8, 8, codes(204, 0, 99))),
              ElementsAre(AllOf(HasSubstr("clear coats are shown"), HasSubstr("'car'"))));
  EXPECT_NEAR(scene.materials[0].specular, 0.8, 1e-7);
  EXPECT_EQ(scene.materials[0].roughness, 0.0);
  EXPECT_EQ(scene.materials[0].specular_color, Rgb(1.0));
  EXPECT_EQ(scene.materials[0].clear_coat, 0.0) << "settled";

  Scene bare = square(material);
  EXPECT_THAT(fold(bare, filled(8, 8, codes(0, 0, 99))), IsEmpty()) << "no lacquer at all";
  EXPECT_EQ(bare.materials[0].roughness, 0.5);

  TexturePixels image = filled(8, 8, codes(255, 0, 0));
  texel(image, 3, 3).g = 1.0F;
  Scene varied = square(material);
  EXPECT_THAT(fold(varied, image),
              ElementsAre(HasSubstr("clear coats that vary are left out"),
                          HasSubstr("as smooth itself are left out")));
  EXPECT_EQ(varied.materials[0].roughness, 0.5);
}

TEST(ConstantTextures, TellWhetherThereIsMetalUnderAClearCoat) {
  Material material = lacquered_paint();
  material.specular_texture = material.specular_color_texture = std::nullopt;
  material.roughness = material.metallic = material.clear_coat = 1.0;
  material.metallic_roughness_texture = TextureUse{.texture = TextureId{0}};
  for (const float metallic : {0.0F, 1.0F}) {
    Scene scene = square(material);
    const auto said = fold(scene, filled(4, 4, glm::vec4(0.0F, 0.5F, metallic, 1.0F)));
    EXPECT_THAT(said, ElementsAre(HasSubstr(metallic > 0.0F ? "left out" : "shown")));
    EXPECT_EQ(scene.materials[0].roughness, metallic > 0.0F ? 0.5 : 0.0);
  }
}

TEST(ConstantTextures, OfSmoothMetalMakeMirrors) {
  Scene scene = square(rough_metal());
  EXPECT_FALSE(is_mirror(scene.materials[0]));
  EXPECT_TRUE(is_mirror(folded(scene, filled(64, 64, codes(0, 0, 255))).materials[0]));
}

TEST(ConstantTextures, OnlyChannelsThatAreReadCount) {
  TexturePixels image = filled(16, 16, codes(0, 0, 255));
  for (int k = 0; k < 16; ++k)
    texel(image, k, k).r = texel(image, 15 - k, k).a = 0.01F * static_cast<float>(k); // occlusion
  Scene scene = square(rough_metal());
  EXPECT_TRUE(is_mirror(folded(scene, image).materials[0]));
}

TEST(ConstantTextures, NoiseOfOneCodeIsNoneAndMoreIsSeen) {
  std::mt19937 engine(3);
  for (const auto& [noise, constant] : {std::pair(1U, true), {2U, true}, {3U, false}}) {
    TexturePixels image = filled(40, 40, codes(0, 0, 255));
    for (glm::vec4& t : image.texels) {
      t.g = static_cast<float>(engine() % (noise + 1U)) / 255.0F;
      t.b = static_cast<float>(255U - engine() % (noise + 1U)) / 255.0F;
    }
    Scene scene = square(rough_metal());
    folded(scene, image);
    EXPECT_EQ(is_textured(scene.materials[0]), !constant) << noise;
    if (constant) {
      // What is cut off at 0 and 1 has its mean there.
      EXPECT_EQ(scene.materials[0].roughness, 0.0);
      EXPECT_EQ(scene.materials[0].metallic, 1.0);
    }
  }
}

TEST(ConstantTextures, ColoursAreComparedAsTheyAreStored) {
  // Linear values of codes 250 and 251 differ by more than those of codes 10 and 30.
  const auto linear = [](double code) {
    return static_cast<float>(std::pow((code / 255.0 + 0.055) / 1.055, 2.4));
  };
  Material paint;
  paint.base_color_texture = TextureUse{.texture = TextureId{0}};
  for (const auto& [a, b, constant] : {std::tuple(249.0, 251.0, true), {20.0, 24.0, false}}) {
    TexturePixels image = filled(8, 8, glm::vec4(linear(a)));
    texel(image, 3, 4) = glm::vec4(linear(b));
    Scene scene = square(paint);
    folded(scene, image);
    EXPECT_EQ(is_textured(scene.materials[0]), !constant) << a;
  }
}

TEST(ConstantTextures, OnlyTexelsThatAreShownCount) {
  // An atlas: the left half is a mirror, the right half is not.
  TexturePixels atlas = filled(64, 64, codes(0, 0, 255));
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x)
      texel(atlas, x, y) = codes(0, static_cast<float>(x + y), 0);
  const auto shown = [&](glm::vec2 low, glm::vec2 high, Wrap wrap) {
    Scene scene = square(rough_metal(), low, high);
    scene.textures[0].wrap_u = wrap;
    return is_mirror(folded(scene, atlas).materials[0]);
  };
  EXPECT_TRUE(shown({0.01, 0.0}, {0.49, 1.0}, Wrap::repeat));
  EXPECT_FALSE(shown({0.01, 0.0}, {0.51, 1.0}, Wrap::repeat));
  EXPECT_FALSE(shown({0.0, 0.0}, {0.49, 1.0}, Wrap::repeat)) << "interpolated with the last column";
  EXPECT_TRUE(shown({3.02, 0.0}, {3.48, 7.0}, Wrap::repeat));
  EXPECT_TRUE(shown({-0.98, 0.0}, {-0.52, 1.0}, Wrap::repeat));
  EXPECT_TRUE(shown({-5.0, -1.0}, {0.4, 2.0}, Wrap::clamp));
  EXPECT_FALSE(shown({0.4, 0.0}, {5.0, 1.0}, Wrap::clamp));
  EXPECT_TRUE(shown({-0.45, 0.0}, {0.45, 1.0}, Wrap::mirrored));
  EXPECT_TRUE(shown({1.55, 0.0}, {2.45, 1.0}, Wrap::mirrored));
  EXPECT_FALSE(shown({0.55, 0.0}, {1.45, 1.0}, Wrap::mirrored));
  EXPECT_FALSE(shown({1e300, 0.0}, {-1e300, 1.0}, Wrap::repeat));
}

TEST(ConstantTextures, PartsOfAnAtlasGetMaterialsOfTheirOwn) {
  TexturePixels atlas = filled(64, 64, codes(0, 0, 255));
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x)
      texel(atlas, x, y) = codes(0, static_cast<float>(100 + x + y), 0);
  Scene scene;
  scene.textures = {{.name = "t", .encoded = {}}};
  add_square(scene, "mirror", rough_metal(), {0.05, 0.05}, {0.4, 0.9});
  add_square(scene, "cloth", rough_metal(), {0.55, 0.05}, {0.9, 0.9}, 2.0);
  add_square(scene, "second mirror", rough_metal(), {0.1, 0.1}, {0.2, 0.2}, 4.0);
  folded(scene, atlas);
  const auto material = [&](std::size_t triangle) -> const Material& {
    return scene.materials[index(scene.triangles[triangle].material)];
  };
  EXPECT_TRUE(is_mirror(material(0)));
  EXPECT_TRUE(material(2).metallic_roughness_texture.has_value());
  EXPECT_EQ(scene.triangles[4].material, scene.triangles[0].material);
  EXPECT_EQ(scene.triangles[5].material, scene.triangles[0].material);
}

TEST(ConstantTextures, WhatIsDarkInAnAtlasOfLampsIsNoLamp) {
  TexturePixels atlas = filled(64, 64, codes(0, 0, 0));
  texel(atlas, 50, 50) = codes(255, 200, 100);
  Material glowing;
  glowing.emission = Rgb(5.0);
  glowing.emissive_texture = TextureUse{.texture = TextureId{0}};
  Scene scene;
  scene.textures = {{.name = "t", .encoded = {}}};
  add_square(scene, "body", glowing, {0.0, 0.0}, {0.5, 0.5});
  add_square(scene, "pilot lamp", glowing, {0.6, 0.6}, {0.9, 0.9}, 2.0);
  scene.textures[0].wrap_u = scene.textures[0].wrap_v = Wrap::clamp;
  folded(scene, atlas);
  EXPECT_FALSE(is_emitter(material_of(scene, TriangleId{0})));
  EXPECT_TRUE(is_emitter(material_of(scene, TriangleId{2})));
}

TEST(ConstantTextures, CutOutsWithoutHolesAreOpaque) {
  Material leaf;
  leaf.alpha_mode = AlphaMode::mask;
  leaf.base_color_texture = TextureUse{.texture = TextureId{0}};
  TexturePixels image = filled(16, 16, codes(10, 20, 30, 200));
  texel(image, 4, 4) = codes(200, 100, 0, 130);
  Scene opaque = square(leaf);
  EXPECT_EQ(folded(opaque, image).materials[0].alpha_mode, AlphaMode::opaque);
  texel(image, 5, 4).a = 0.4F;
  Scene holed = square(leaf);
  EXPECT_EQ(folded(holed, image).materials[0].alpha_mode, AlphaMode::mask);
  Scene faded = square(leaf);
  own_attributes(faded, faded.vertices[1]).color.a = 0.5F;
  EXPECT_EQ(folded(faded, filled(4, 4, codes(9, 9, 9))).materials[0].alpha_mode, AlphaMode::mask);
}

// What is blended by a texture: opaque where that says so, a cut-out where alpha is an outline,
// and open in part where it is a veil.
TEST(ConstantTextures, BlendingIsWhatItsTexelsMakeOfIt) {
  Material veil;
  veil.alpha_mode = AlphaMode::blend;
  veil.transmission = 1.0;
  veil.base_color_texture = TextureUse{.texture = TextureId{0}};
  TexturePixels image = filled(32, 32, codes(10, 20, 30, 255));
  const auto folded_veil = [&] {
    Scene scene = square(veil);
    return folded(scene, image).materials[0];
  };
  EXPECT_EQ(folded_veil().alpha_mode, AlphaMode::opaque);
  EXPECT_FALSE(is_glass(folded_veil()));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      texel(image, x, y).a = y == 15 ? 0.5F : 0.0F;
  EXPECT_EQ(folded_veil().alpha_mode, AlphaMode::mask);
  EXPECT_EQ(folded_veil().alpha_cutoff, 0.5);
  EXPECT_FALSE(is_glass(folded_veil()));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      texel(image, x, y).a = 0.5F;
  EXPECT_TRUE(is_blended(folded_veil()));
  EXPECT_TRUE(folded_veil().double_sided);
}

TEST(ConstantTextures, BlackTransmissionIsNoGlass) {
  Material pane;
  pane.transmission = 1.0;
  pane.transmission_texture = TextureUse{.texture = TextureId{0}};
  Scene scene = square(pane);
  EXPECT_FALSE(is_glass(folded(scene, filled(8, 8, codes(0, 255, 255))).materials[0]));
}

TEST(ConstantTextures, NearlyConstantRoughnessIsItsMeanForPassOne) {
  std::mt19937 engine(5);
  for (const auto& [noise, near] : {std::pair(15U, true), {30U, false}}) {
    TexturePixels image = filled(40, 40, codes(0, 0, 255));
    for (glm::vec4& t : image.texels)
      t.g = static_cast<float>(engine() % (noise + 1U)) / 255.0F;
    Scene scene = square(rough_metal());
    folded(scene, image);
    EXPECT_TRUE(is_textured(scene.materials[0])) << "pass two shows it";
    EXPECT_EQ(is_mirror(scene.materials[0]), near) << noise;
  }
}

// A texel in the middle of a triangle, whichever way the image is wrapped, is found,
// and one that no point of it is interpolated from is not.
TEST(TexelRanges, HoldTheTexelsThatATriangleShows) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto dark = [](const glm::vec4&, const glm::vec4& high) { return high.r < 0.5F; };
  int shown_count = 0;
  for (int round = 0; round < 600; ++round) {
    TexturePixels image = filled(45, 23, glm::vec4(0.0F));
    texel(image, static_cast<int>(engine() % 45U), static_cast<int>(engine() % 23U)) =
        glm::vec4(1.0F);
    const auto wrap = static_cast<Wrap>(round % 3);
    const Texture texture{.name = "t", .encoded = {}, .wrap_u = wrap, .wrap_v = wrap};
    const Vec2 origin(4.0 * unit(engine) - 2.0, 4.0 * unit(engine) - 2.0);
    std::array<Vec2, 3> uv;
    for (Vec2& corner : uv)
      corner = origin + Vec2(unit(engine), unit(engine)) * (round % 2 == 0 ? 0.2 : 0.9);
    double most = 0.0;
    for (int k = 0; k < 4000; ++k) {
      double s = unit(engine), t = unit(engine);
      if (s + t > 1.0) {
        s = 1.0 - s;
        t = 1.0 - t;
      }
      const Vec2 at = uv[0] + s * (uv[1] - uv[0]) + t * (uv[2] - uv[0]);
      most = std::max(most, texture_value(image, texture, at).r);
    }
    TexelRange range;
    std::int64_t work = 100'000;
    const bool found = !TexelRanges(image, texture).add(uv, dark, range, work);
    EXPECT_GE(work, 0);
    EXPECT_TRUE(found || most == 0.0) << round;
    // Samples miss what a triangle just touches, and clamped triangles count with their rectangles.
    if (wrap != Wrap::clamp && found && most == 0.0)
      ++shown_count;
  }
  EXPECT_LE(shown_count, 20) << "of 400: found, and not seen by any sample";
}

// Blank maps of exporters have 127 or 128, and JPEG's noise; one that leans turns the surface.
TEST(ConstantTextures, NormalMapsThatLeanToNoSideAreNone) {
  const auto stays = [](const glm::vec4& texel) {
    Material material;
    material.normal_texture = TextureUse{.texture = TextureId{0}};
    Scene scene = square(material);
    fold(scene, filled(4, 4, texel));
    return scene.materials[0].normal_texture.has_value();
  };
  EXPECT_FALSE(stays(codes(128, 128, 255)));
  EXPECT_FALSE(stays(codes(127, 126, 254)));
  EXPECT_TRUE(stays(codes(160, 128, 250)));
  EXPECT_TRUE(stays(codes(128, 90, 250)));
}

} // namespace
} // namespace meninas::test
