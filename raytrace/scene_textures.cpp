#include "raytrace/scene_textures.h"

#include "image/image_file.h"
#include "scenes/materials/constant_textures.h"
#include "scenes/errors.h"
#include "scenes/sky/cube_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {

static TexturePixels decoded(const Texture& texture, TextureContent content) {
  const Encoding encoding = content == TextureContent::colour ? Encoding::srgb : Encoding::linear;
  Bitmap image = decode_image(texture.encoded, encoding, texture.name);
  return {image.width, image.height, std::move(image.pixels)};
}

/// A texture that cannot be decoded changes nothing: white times the factor. A warning says so.
static DecodedTextures decoded_or_white(const Scene& scene, std::vector<std::string>& warnings) {
  return decode_textures(scene, [&](const Texture& texture, TextureContent content) {
    try {
      return decoded(texture, content);
    } catch (const InputError& problem) {
      warnings.push_back(fmt::format("{}: the factor is used alone", problem.what()));
      return TexturePixels{1, 1, {glm::vec4(1.0F)}, true};
    }
  });
}

void settle_sky(Scene& scene, std::vector<std::string>& warnings) {
  settle_environment(
      scene.background,
      [](std::span<const std::byte> encoded, const std::string& name) {
        Bitmap image = decode_image(encoded, Encoding::srgb, name);
        return TexturePixels{image.width, image.height, std::move(image.pixels)};
      },
      warnings);
}

DecodedTextures settle_textures(Scene& scene, std::vector<std::string>& warnings) {
  DecodedTextures textures = decoded_or_white(scene, warnings);
  std::ranges::move(fold_constant_textures(scene, textures), std::back_inserter(warnings));
  weigh_colours(scene, textures);
  settle_sky(scene, warnings);
  return textures;
}

} // namespace meninas
