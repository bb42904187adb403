// Textures over footprints:
// means in the pyramid, and look-ups that average as much as they are told and no more.
#include "scenes/materials/texture_lookup.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/texture_pyramid.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace meninas::test {
namespace {

TexturePixels noise(int width, int height) {
  TexturePixels image{width, height, {}};
  for (int k = 0; k < width * height; ++k)
    image.texels.emplace_back(glm::vec4(float(k * 7919 % 101) / 101.0F));
  image.coarser = coarser_levels(image);
  return image;
}

double mean_of(const TexturePixels& image) {
  double sum = 0.0;
  for (const glm::vec4& texel : image.texels)
    sum += double{texel.r} / double(image.texels.size());
  return sum;
}

const Texture repeating{.name = "t", .encoded = {}};

TEST(TexturePyramid, EveryLevelHasTheMeanOfTheImageAtAnySize) {
  for (const auto& [width, height] :
       {std::pair{64, 64}, {5, 3}, {37, 1}, {1, 9}, {100, 7}, {1, 1}}) {
    const TexturePixels image = noise(width, height);
    int w = width, h = height;
    for (const TexturePixels& level : image.coarser) {
      w = std::max(1, w / 2);
      h = std::max(1, h / 2);
      EXPECT_EQ(level.width, w);
      EXPECT_EQ(level.height, h);
      // Sums of a hundred floats.
      EXPECT_NEAR(mean_of(level), mean_of(image), 1e-5);
    }
    EXPECT_EQ(w * h, 1);
  }
}

TEST(TexturePyramid, APointIsLookedUpInTheImageItself) {
  const TexturePixels image = noise(16, 16);
  TexturePixels alone = image;
  alone.coarser.clear();
  for (const Vec2 uv : {Vec2(0.3, 0.4), Vec2(0.0, 1.7)})
    for (const double size : {0.0, 0.5 / 16.0, 1.0 / 16.0})
      EXPECT_EQ(texture_value(image, repeating, uv, {{size, 0.0}, {0.0, size}}),
                texture_value(alone, repeating, uv));
}

TEST(TexturePyramid, AFootprintAsLargeAsTheImageIsItsMean) {
  const TexturePixels image = noise(32, 16);
  for (const Vec2 uv : {Vec2(0.3, 0.4), Vec2(0.9, 0.05)})
    for (const double times : {1.0, 3.0, 1e6})
      EXPECT_NEAR(texture_value(image, repeating, uv, {{times, 0.0}, {0.0, times}}).r,
                  mean_of(image), 1e-5);
}

TEST(TexturePyramid, ALongFootprintBlursAlongItselfAlone) {
  // Columns of 0 and 1: along them nothing changes, across them all is lost.
  TexturePixels columns{64, 64, {}};
  for (int k = 0; k < 64 * 64; ++k)
    columns.texels.emplace_back(glm::vec4(k % 64 % 8 < 4 ? 1.0F : 0.0F));
  columns.coarser = coarser_levels(columns);
  const Vec2 white(2.0 / 64.0, 0.5), black(6.0 / 64.0, 0.5);
  const Vec2 texel(1.0 / 64.0, 0.0), long_down(0.0, 16.0 / 64.0), long_across(16.0 / 64.0, 0.0);
  EXPECT_NEAR(texture_value(columns, repeating, white, {long_down, texel}).r, 1.0, 1e-6);
  EXPECT_NEAR(texture_value(columns, repeating, black, {texel, long_down}).r, 0.0, 1e-6)
      << "whichever is called the longer";
  for (const Vec2& uv : {white, black})
    EXPECT_NEAR(texture_value(columns, repeating, uv, {long_across, {0.0, 1.0 / 64.0}}).r, 0.5,
                1e-6)
        << "two whole periods";
}

TEST(TexturePyramid, FootprintsWithoutEndAreFinite) {
  const TexturePixels image = noise(8, 8);
  for (const double size : {1e-300, 1e300, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(
        std::isfinite(texture_value(image, repeating, {0.5, 0.5}, {{size, 0.0}, {0.0, size}}).r));
}

/// A quad that shows an image once, of 64 x 64 texels by their place; a texture of numbers may have another size.
struct Painted {
  Scene scene;
  DecodedTextures textures;

  Painted(Material material, const std::function<glm::vec4(int x, int y)>& colour,
          const std::function<glm::vec4(int x, int y)>& number, int size_of_numbers) {
    add_polygon(scene, "quad", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, material);
    for (Vertex& vertex : scene.vertices)
      own_attributes(scene, vertex).texcoord[0] = glm::vec2(vertex.position);
    scene.textures = {{.name = "colour", .encoded = {}}, {.name = "number", .encoded = {}}};
    scene.materials[0].base_color_texture = TextureUse{.texture = TextureId{0}};
    if (number)
      scene.materials[0].metallic_roughness_texture = TextureUse{.texture = TextureId{1}};
    textures = decode_textures(scene, [&](const Texture& texture, TextureContent) {
      const bool is_colour = texture.name == "colour";
      const int size = is_colour ? 64 : size_of_numbers;
      TexturePixels image{size, size, {}};
      for (int k = 0; k < size * size; ++k)
        image.texels.push_back((is_colour ? colour : number)(k % size, k / size));
      return image;
    });
    weigh_colours(scene, textures);
  }

  /// Over `width` of the image, about the middle of its first triangle.
  MaterialPoint at(double width) const {
    return material_at(scene, textures, TriangleId{0}, Vec2(1.0 / 3.0),
                       {{width, 0.0}, {0.0, width}});
  }
};

Material metal_by_texture() {
  Material material;
  material.base_color = Rgb(0.5, 1.0, 1.0);
  material.metallic = 0.8;
  return material;
}

TEST(TexturePyramid, MetalTakesTheColourOfItsOwnTexels) {
  // Stripes of four texels: bright metal beside dark paint. The image of numbers may be coarser or finer;
  // between texels as wide as a stripe its values rise and fall evenly, and three quarters of the metal are in its stripe.
  for (const auto& [size, bright] : {std::pair{16, 0.75}, {64, 1.0}, {256, 1.0}}) {
    const Painted both(
        metal_by_texture(),
        [](int x, int) { return glm::vec4(glm::vec3(x / 4 % 2 == 0 ? 0.9F : 0.1F), 1.0F); },
        [size](int x, int) {
          return glm::vec4(0.0F, 1.0F, x * 64 / size / 4 % 2 == 0 ? 1.0F : 0.0F, 1.0F);
        },
        size);
    // Half of it is metal for a share of 0.8; the rest is paint.
    const Rgb factor(0.5, 1.0, 1.0);
    const double metal = 0.5 * 0.8 * (bright * 0.9 + (1.0 - bright) * 0.1);
    const MaterialPoint point = both.at(1.0);
    const Bsdf bsdf = make_bsdf(both.scene.materials[0], point);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(bsdf.metal[c], factor[c] * metal, 1e-5) << size;
      EXPECT_NEAR(bsdf.diffuse[c], factor[c] * (0.5 - metal), 1e-5) << size;
    }
    EXPECT_NEAR(point.base_color.g, 0.5, 1e-5);
    EXPECT_NEAR(point.metallic, 0.4, 1e-5);
    EXPECT_EQ(both.at(0.0).metal_covariance, Rgb(0.0)) << "a point has both as they are";
  }
}

TEST(TexturePyramid, ColoursThatDoNotGoWithMetalAreItsMean) {
  const Painted across(
      metal_by_texture(),
      [](int x, int) { return glm::vec4(glm::vec3(x / 4 % 2 == 0 ? 0.9F : 0.1F), 1.0F); },
      [](int, int y) { return glm::vec4(0.0F, 1.0F, y / 4 % 2 == 0 ? 1.0F : 0.0F, 1.0F); }, 64);
  EXPECT_NEAR(across.at(1.0).metal_covariance.g, 0.0, 1e-6);
}

// Sixty materials of one atlas take the memory of one, and metalness that is the same all over, but for noise, takes none.
TEST(TexturePyramid, MaterialsOfTheSameImagesShareWhatIsWeighed) {
  const auto colour = [](int x, int) { return glm::vec4(glm::vec3(x % 2 == 0 ? 0.9F : 0.1F), 1.0F); };
  Painted painted(metal_by_texture(), colour,
                  [](int x, int) { return glm::vec4(0.0F, 1.0F, x % 2 == 0 ? 1.0F : 0.0F, 1.0F); }, 64);
  Material tinted = painted.scene.materials[0];
  tinted.base_color = Rgb(0.2);
  Material cut = tinted;
  cut.alpha_mode = AlphaMode::mask;
  painted.scene.materials.push_back(tinted);
  painted.scene.materials.push_back(cut);
  weigh_colours(painted.scene, painted.textures);
  const auto& weighed = painted.textures.weighed;
  ASSERT_NE(weighed[0], nullptr);
  EXPECT_EQ(weighed[0], weighed[1]);
  EXPECT_NE(weighed[0], weighed[2]) << "its alpha counts";

  const Painted noisy(metal_by_texture(), colour, [](int x, int) {
    return glm::vec4(0.0F, 1.0F, float(x % 3) / 255.0F, 1.0F);
  }, 64);
  EXPECT_EQ(noisy.textures.weighed[0], nullptr);
}

TEST(TexturePyramid, WhatIsCutOutHasNoColour) {
  Material leaf;
  leaf.base_color = Rgb(1.0);
  leaf.alpha_mode = AlphaMode::mask;
  // A leaf of 0.6 in every second stripe, and black where nothing is.
  const auto texel = [](int x, int) {
    return x / 4 % 2 == 0 ? glm::vec4(0.6F, 0.6F, 0.6F, 1.0F) : glm::vec4(0.0F);
  };
  const Painted cut(leaf, texel, nullptr, 1);
  EXPECT_NEAR(cut.at(1.0).base_color.g, 0.6, 1e-5);
  EXPECT_NEAR(cut.at(1.0).alpha, 0.5, 1e-5) << "which is a mean";

  // Blended, half of it covers by 0.6 and a quarter as much by 0.2: (0.6 + 0.25 * 0.2) / 1.25.
  leaf.alpha_mode = AlphaMode::blend;
  leaf.transmission = 1.0; // as the reader sets it, where a texture opens it
  const auto two = [](int x, int) {
    return x / 4 % 2 == 0 ? glm::vec4(0.6F, 0.6F, 0.6F, 1.0F) : glm::vec4(0.2F, 0.2F, 0.2F, 0.25F);
  };
  EXPECT_NEAR(Painted(leaf, two, nullptr, 1).at(1.0).base_color.g, (0.6 + 0.25 * 0.2) / 1.25, 1e-5);

  // An opaque material has no alpha, whatever its image says.
  leaf.alpha_mode = AlphaMode::opaque;
  EXPECT_NEAR(Painted(leaf, texel, nullptr, 1).at(1.0).base_color.g, 0.3, 1e-5);
}

} // namespace
} // namespace meninas::test
