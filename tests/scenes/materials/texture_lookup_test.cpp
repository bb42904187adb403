// Textures at a point: where they are looked up, how they wrap, and what they make of a material.
#include "scenes/materials/texture_lookup.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// Two texels wide and two high: 0 1 / 2 3 in all channels.
TexturePixels numbered() {
  return {2, 2, {glm::vec4(0), glm::vec4(1), glm::vec4(2), glm::vec4(3)}};
}

double value(const Texture& texture, Vec2 uv) { return texture_value(numbered(), texture, uv).r; }

TEST(TextureLookup, TexelsAreAtTheirCentresAndBetweenThemIsTheMean) {
  const Texture texture{.name = "t", .encoded = {}, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
  EXPECT_DOUBLE_EQ(value(texture, {0.25, 0.25}), 0.0);
  EXPECT_DOUBLE_EQ(value(texture, {0.75, 0.25}), 1.0);
  EXPECT_DOUBLE_EQ(value(texture, {0.25, 0.75}), 2.0);
  EXPECT_DOUBLE_EQ(value(texture, {0.5, 0.25}), 0.5);
  EXPECT_DOUBLE_EQ(value(texture, {0.5, 0.5}), 1.5);
}

TEST(TextureLookup, ImagesRepeatOrEndAtTheirEdge) {
  const Texture ends{.name = "t", .encoded = {}, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
  EXPECT_DOUBLE_EQ(value(ends, {-3.0, 0.25}), 0.0);
  EXPECT_DOUBLE_EQ(value(ends, {7.0, 0.25}), 1.0);
  EXPECT_DOUBLE_EQ(value(ends, {0.0, 0.25}), 0.0);
  const Texture repeats{.name = "t", .encoded = {}, .wrap_u = Wrap::repeat, .wrap_v = Wrap::repeat};
  EXPECT_DOUBLE_EQ(value(repeats, {0.0, 0.25}), 0.5);
  EXPECT_DOUBLE_EQ(value(repeats, {-2.75, 5.25}), 0.0);
  EXPECT_DOUBLE_EQ(value(repeats, {3.75, -0.25}), 3.0);
  EXPECT_TRUE(std::isfinite(value(repeats, {1e300, -1e300})));
}

TEST(TextureLookup, ImagesRepeatAsTheirMirrorImage) {
  const Texture mirrors{
      .name = "t", .encoded = {}, .wrap_u = Wrap::mirrored, .wrap_v = Wrap::clamp};
  // 0 1 | 1 0 | 0 1: to both sides of both edges.
  for (const auto& [u, expected] :
       {std::pair{0.25, 0.0}, {0.75, 1.0}, {1.25, 1.0}, {1.75, 0.0}, {2.25, 0.0}, {2.75, 1.0},
        {-0.25, 0.0}, {-0.75, 1.0}, {-1.25, 1.0}, {1.0, 1.0}, {0.0, 0.0}, {1.5, 0.5}})
    EXPECT_DOUBLE_EQ(value(mirrors, {u, 0.25}), expected) << u;
  EXPECT_TRUE(std::isfinite(value(mirrors, {-1e300, 0.0})));
}

TEST(TextureLookup, MagnifiedToSquares) {
  const Texture squares{.name = "t", .encoded = {}, .magnified = TexelFilter::nearest};
  EXPECT_DOUBLE_EQ(value(squares, {0.49, 0.01}), 0.0);
  EXPECT_DOUBLE_EQ(value(squares, {0.51, 0.49}), 1.0);
  EXPECT_DOUBLE_EQ(value(squares, {0.51, 0.51}), 3.0);
  EXPECT_DOUBLE_EQ(value(squares, {-0.01, 0.99}), 3.0);
}

TEST(TextureLookup, TheTransformOfTheSpecificationsExample) {
  // KHR_texture_transform: the lower left quadrant, rotated clockwise by a right angle.
  TextureUse use;
  use.offset = {0.0, 1.0};
  use.rotation = std::numbers::pi / 2.0;
  use.scale = {0.5, 0.5};
  const auto expect = [&](Vec2 uv, Vec2 there) {
    const Vec2 found = transformed_texcoord(use, uv);
    EXPECT_NEAR(found.x, there.x, 1e-12);
    EXPECT_NEAR(found.y, there.y, 1e-12);
  };
  expect({0, 0}, {0.0, 1.0});
  expect({1, 0}, {0.0, 0.5});
  expect({0, 1}, {0.5, 1.0});
  expect({1, 1}, {0.5, 0.5});
}

TEST(TextureLookup, FactorsTimesTexturesByTheirCoordinates) {
  Scene scene;
  Material material = diffuse(Rgb(0.5, 0.6, 0.7), Rgb(std::numbers::pi));
  material.metallic = 0.8;
  material.roughness = 0.5;
  material.alpha = 0.9;
  add_polygon(scene, "quad", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
  for (Vertex& vertex : scene.vertices) {
    own_attributes(scene, vertex).texcoord[0] = {0.1F, 0.1F};
    own_attributes(scene, vertex).texcoord[1] = glm::vec2(vertex.position);
  }
  scene.textures = {{.name = "a", .encoded = {}}, {.name = "b", .encoded = {}}};
  scene.materials[0].base_color_texture = TextureUse{.texture = TextureId{0}, .texcoord_set = 1};
  scene.materials[0].metallic_roughness_texture = TextureUse{.texture = TextureId{1}};
  scene.materials[0].emissive_texture = TextureUse{.texture = TextureId{1}};
  const auto decode = [](const Texture& texture, TextureContent content) -> TexturePixels {
    if (texture.name == "b")
      return {
          1,
          1,
          {content == TextureContent::colour ? glm::vec4(3, 2, 1, 1) : glm::vec4(9, 0.5, 0.25, 1)}};
    return {2, 1, {glm::vec4(0.0F), glm::vec4(1, 0.5, 0.25, 0.5)}};
  };
  const DecodedTextures textures = decode_textures(scene, decode);
  EXPECT_TRUE(textures.numbers[0].texels.empty());
  // The second triangle has the corners (0,0), (1,1), (0,1): this is the point (0.75, 0.75).
  const MaterialPoint point = material_at(scene, textures, TriangleId{1}, {0.75, 0.0});
  EXPECT_NEAR(point.base_color.r, 0.5, 1e-7);
  EXPECT_NEAR(point.base_color.g, 0.3, 1e-7);
  EXPECT_NEAR(point.base_color.b, 0.7 * 0.25, 1e-7);
  EXPECT_NEAR(point.alpha, 0.45, 1e-7);
  EXPECT_NEAR(point.roughness, 0.25, 1e-7);
  EXPECT_NEAR(point.metallic, 0.2, 1e-7);
  EXPECT_NEAR(point.emission.r, 3.0, 1e-7);
  EXPECT_NEAR(point.emission.b, 1.0, 1e-7);
  scene.materials[0].alpha_mode = AlphaMode::mask;
  EXPECT_TRUE(is_cut_out(scene.materials[0], point));

  // The triangle's corners are the first, third and fourth vertex.
  EXPECT_FALSE(has_vertex_colors(scene, TriangleId{1}));
  own_attributes(scene, scene.vertices[2]).color = {0.5F, 1.0F, 0.0F, 0.0F};
  EXPECT_TRUE(has_vertex_colors(scene, TriangleId{1}));
  const MaterialPoint tinted = material_at(scene, textures, TriangleId{1}, {0.75, 0.0});
  EXPECT_NEAR(tinted.base_color.r, 0.5 * 0.625, 1e-7);
  EXPECT_NEAR(tinted.base_color.g, 0.3, 1e-7);
  EXPECT_NEAR(tinted.base_color.b, 0.7 * 0.25 * 0.25, 1e-7);
  EXPECT_NEAR(tinted.alpha, 0.45 * 0.25, 1e-7);
  EXPECT_EQ(tinted.emission, point.emission);
}

} // namespace
} // namespace meninas::test
