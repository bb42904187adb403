#include "reference/scene_setup.h"

#include "image/image_file.h"
#include "reference/light_images.h"
#include "reference/mirror_planes.h"
#include "scenes/errors.h"
#include "scenes/materials/constant_textures.h"
#include "scenes/rays/mixed_scales.h"
#include "scenes/sky/cube_faces.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace meninas::reference {

namespace {

/// White, which leaves the factor as it is, where it cannot be decoded.
TexturePixels decode(const Texture& texture, TextureContent content,
                     std::vector<std::string>& warnings) {
  try {
    Bitmap bitmap = decode_image(
        texture.encoded, content == TextureContent::colour ? Encoding::srgb : Encoding::linear,
        texture.name);
    return {bitmap.width, bitmap.height, std::move(bitmap.pixels)};
  } catch (const InputError& problem) {
    warnings.push_back(std::string(problem.what()) + ": the factor is used alone");
    return {1, 1, {glm::vec4(1.0F)}, true};
  }
}

bool is_see_through(const Material& material) {
  return material.alpha_mode == AlphaMode::mask || material.transmission > 0.0;
}

} // namespace

TracedScene make_traced_scene(Scene scene) {
  DecodedTextures textures =
      decode_textures(scene, [&](const Texture& texture, TextureContent content) {
        return decode(texture, content, scene.warnings);
      });
  std::ranges::move(fold_constant_textures(scene, textures), std::back_inserter(scene.warnings));
  settle_environment(
      scene.background,
      [](std::span<const std::byte> encoded, const std::string& name) {
        Bitmap image = decode_image(encoded, Encoding::srgb, name);
        return TexturePixels{image.width, image.height, std::move(image.pixels)};
      },
      scene.warnings);
  SurfaceModel surfaces = find_surfaces(scene);
  RayScene rays = make_ray_scene(scene, surfaces);
  std::ranges::move(warnings_of_mixed_scales(scene, surfaces, rays),
                    std::back_inserter(scene.warnings));
  std::vector<Direction> normals;
  normals.reserve(scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    normals.push_back(glm::normalize(area_vector(corners(scene, TriangleId{t}))));
  std::vector<Bsdf> bsdfs;
  bsdfs.reserve(scene.materials.size());
  for (const Material& material : scene.materials)
    bsdfs.push_back(make_bsdf(material, untextured(material)));
  LightTable lights = make_light_table(scene, textures);
  auto [mirror_planes, metals_left_out] = find_mirror_planes(scene, surfaces, bsdfs, textures);
  if (metals_left_out > 0 && !scene.lights.empty())
    scene.warnings.push_back(
        "light of punctual lights by way of " + std::to_string(metals_left_out) +
        " planes of mirrors is left out: of at most " + std::to_string(max_mirror_planes) +
        " it is followed");
  std::vector<LightImage> light_images = make_light_images(scene, surfaces, bsdfs, mirror_planes);
  SkyTable sky = make_sky_table(scene.background);
  const bool see_through = std::ranges::any_of(scene.materials, is_see_through);
  return {std::move(scene),        std::move(surfaces), std::move(rays),   std::move(normals),
          std::move(textures),     std::move(bsdfs),    std::move(lights), std::move(mirror_planes),
          std::move(light_images), std::move(sky),      see_through};
}

} // namespace meninas::reference
