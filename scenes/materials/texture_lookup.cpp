#include "scenes/materials/texture_lookup.h"

#include "scenes/materials/texture_pyramid.h"
#include "scenes/materials/texture_slots.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The texel that index k stands for.
int wrapped(std::int64_t k, int size, Wrap wrap) {
  if (wrap == Wrap::clamp)
    return static_cast<int>(std::clamp<std::int64_t>(k, 0, size - 1));
  const std::int64_t period = wrap == Wrap::mirrored ? 2 * std::int64_t{size} : size;
  const std::int64_t rest = (k % period + period) % period;
  return static_cast<int>(std::min(rest, period == size ? rest : period - 1 - rest));
}

/// The texel below a coordinate and how far the coordinate is towards the next one.
struct TexelPlace {
  std::int64_t first;
  double share;
};
TexelPlace texel_place(double coordinate, int size) {
  // Coordinates beyond this have no fraction of a texel left.
  const double centred = std::clamp(coordinate * size - 0.5, -1e15, 1e15);
  const double below = std::floor(centred);
  return {static_cast<std::int64_t>(below), centred - below};
}

const VertexAttributes& corner(const Scene& scene, TriangleId triangle, std::size_t k) {
  return attributes_of(scene, scene.triangles[index(triangle)].vertices[k]);
}

Vec2 texcoord_at(const Scene& scene, TriangleId triangle, int set, Vec2 barycentric) {
  const auto at = [&](std::size_t k) {
    return Vec2(corner(scene, triangle, k).texcoord[static_cast<std::size_t>(set)]);
  };
  const Vec2 a = at(0);
  return a + barycentric.x * (at(1) - a) + barycentric.y * (at(2) - a);
}

glm::dvec4 color_at(const Scene& scene, TriangleId triangle, Vec2 barycentric) {
  const auto at = [&](std::size_t k) { return glm::dvec4(corner(scene, triangle, k).color); };
  const glm::dvec4 a = at(0);
  return a + barycentric.x * (at(1) - a) + barycentric.y * (at(2) - a);
}

} // namespace

const DecodedTextures& no_textures() {
  static const DecodedTextures none;
  return none;
}

DecodedTextures decode_textures(const Scene& scene, const DecodeTexture& decode) {
  DecodedTextures decoded;
  decoded.colours.resize(scene.textures.size());
  decoded.numbers.resize(scene.textures.size());
  for (const Material& material : scene.materials)
    for (const TextureSlot& slot : texture_slots) {
      const auto& use = material.*slot.use;
      auto& list = slot.content == TextureContent::colour ? decoded.colours : decoded.numbers;
      if (!use || !list[index(use->texture)].texels.empty())
        continue;
      TexturePixels& pixels = list[index(use->texture)];
      pixels = decode(scene.textures[index(use->texture)], slot.content);
      pixels.coarser = coarser_levels(pixels);
    }
  return decoded;
}

Vec2 transformed_texcoord(const TextureUse& use, Vec2 texcoord) {
  if (use.rotation == 0.0)
    return use.offset + use.scale * texcoord;
  const double c = std::cos(use.rotation), s = std::sin(use.rotation);
  const Vec2 scaled = use.scale * texcoord;
  return use.offset + Vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

/// Between the four texels around a point.
static glm::dvec4 bilinear(const TexturePixels& pixels, const Texture& texture, Vec2 uv) {
  const TexelPlace u = texel_place(uv.x, pixels.width), v = texel_place(uv.y, pixels.height);
  const auto texel = [&](std::int64_t i, std::int64_t j) {
    const int x = wrapped(i, pixels.width, texture.wrap_u);
    const int y = wrapped(j, pixels.height, texture.wrap_v);
    return glm::dvec4(pixels.texels[static_cast<std::size_t>(y) * pixels.width + x]);
  };
  const glm::dvec4 upper = glm::mix(texel(u.first, v.first), texel(u.first + 1, v.first), u.share);
  const glm::dvec4 lower =
      glm::mix(texel(u.first, v.first + 1), texel(u.first + 1, v.first + 1), u.share);
  return glm::mix(upper, lower, v.share);
}

static glm::dvec4 nearest(const TexturePixels& pixels, const Texture& texture, Vec2 uv) {
  const TexelPlace u = texel_place(uv.x, pixels.width), v = texel_place(uv.y, pixels.height);
  const auto rounded = [](const TexelPlace& place) {
    return place.first + (place.share < 0.5 ? 0 : 1);
  };
  const int x = wrapped(rounded(u), pixels.width, texture.wrap_u);
  const int y = wrapped(rounded(v), pixels.height, texture.wrap_v);
  return glm::dvec4(pixels.texels[static_cast<std::size_t>(y) * pixels.width + x]);
}

/// The mean over about `width` texels, one or more, from the two levels around it.
static glm::dvec4 trilinear(const TexturePixels& pixels, const Texture& texture, Vec2 uv,
                            double width) {
  const double coarsest = static_cast<double>(pixels.coarser.size());
  const double level = std::clamp(std::log2(width), 0.0, coarsest);
  const auto below = static_cast<std::size_t>(level);
  const auto at = [&](std::size_t k) {
    return bilinear(k == 0 ? pixels : pixels.coarser[k - 1], texture, uv);
  };
  const double share = level - static_cast<double>(below);
  return share == 0.0 ? at(below) : glm::mix(at(below), at(below + 1), share);
}

glm::dvec4 texture_value(const TexturePixels& pixels, const Texture& texture, Vec2 uv,
                         const Footprint& footprint) {
  constexpr double max_looks = 16.0;
  const Vec2 size(pixels.width, pixels.height);
  Vec2 along = footprint.longer;
  double length = glm::length(size * along), width = glm::length(size * footprint.shorter);
  if (length < width) {
    std::swap(length, width);
    along = footprint.shorter;
  }
  if (!(length > 1.0) || !std::isfinite(length))
    return texture.magnified == TexelFilter::nearest ? nearest(pixels, texture, uv)
                                                     : bilinear(pixels, texture, uv);
  const double looks = std::clamp(std::ceil(length / std::max(width, 1.0)), 1.0, max_looks);
  const double each = std::max({width, length / looks, 1.0});
  glm::dvec4 sum(0.0);
  for (double k = 0.5; k < looks; k += 1.0)
    sum += trilinear(pixels, texture, uv + (k / looks - 0.5) * along, each);
  return sum / looks;
}

glm::dvec4 texel_at(const Scene& scene, const std::vector<TexturePixels>& list,
                    const TextureUse& use, TriangleId triangle, Vec2 barycentric,
                    const Footprint& footprint) {
  const auto place = [&](Vec2 weights) {
    return transformed_texcoord(use, texcoord_at(scene, triangle, use.texcoord_set, weights));
  };
  const Vec2 origin = place(Vec2(0.0)); // the map is affine
  const Footprint covered{place(footprint.longer) - origin, place(footprint.shorter) - origin};
  return texture_value(list[index(use.texture)], scene.textures[index(use.texture)],
                       place(barycentric), covered);
}

bool is_textured(const Material& material) {
  return material.base_color_texture || material.metallic_roughness_texture ||
         material.emissive_texture || material.transmission_texture || material.thickness_texture ||
         material.diffuse_transmission_texture ||
         material.diffuse_transmission_color_texture || material.anisotropy_texture ||
         material.iridescence_texture || material.film_thickness_texture;
}

bool has_vertex_colors(const Scene& scene, TriangleId triangle) {
  const auto is_colored = [&](std::size_t k) {
    return corner(scene, triangle, k).color != glm::vec4(1.0F);
  };
  return is_colored(0) || is_colored(1) || is_colored(2);
}

MaterialPoint material_at(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
                          Vec2 barycentric, const Footprint& footprint) {
  const Material& material = material_of(scene, triangle);
  MaterialPoint point = untextured(material);
  const auto value = [&](const TextureUse& use, const std::vector<TexturePixels>& list) {
    return texel_at(scene, list, use, triangle, barycentric, footprint);
  };
  if (const auto& use = material.base_color_texture) {
    const glm::dvec4 texel = value(*use, textures.colours);
    point.base_color *= glm::clamp(Rgb(texel), 0.0, 1.0);
    point.alpha *= texel.a;
  }
  if (has_vertex_colors(scene, triangle)) {
    const glm::dvec4 color = glm::clamp(color_at(scene, triangle, barycentric), 0.0, 1.0);
    point.base_color *= Rgb(color);
    point.alpha *= color.a;
  }
  if (const auto& use = material.metallic_roughness_texture) {
    const glm::dvec4 texel = value(*use, textures.numbers);
    point.roughness *= std::clamp(texel.g, 0.0, 1.0);
    point.metallic *= std::clamp(texel.b, 0.0, 1.0);
  }
  if (const auto& use = material.transmission_texture)
    point.transmission *= std::clamp(value(*use, textures.numbers).r, 0.0, 1.0);
  if (const auto& use = material.thickness_texture)
    point.thickness *= std::clamp(value(*use, textures.numbers).g, 0.0, 1.0);
  if (const auto& use = material.diffuse_transmission_texture)
    point.diffuse_transmission *= std::clamp(value(*use, textures.numbers).a, 0.0, 1.0);
  if (const auto& use = material.diffuse_transmission_color_texture)
    point.diffuse_transmission_color *= glm::clamp(Rgb(value(*use, textures.colours)), 0.0, 1.0);
  if (const auto& use = material.anisotropy_texture) {
    const glm::dvec4 texel = value(*use, textures.numbers);
    point.anisotropy *= std::clamp(texel.b, 0.0, 1.0);
    point.anisotropy_direction = turned_by_texel(point.anisotropy_direction, texel);
  }
  if (const auto& use = material.iridescence_texture)
    point.film.share *= std::clamp(value(*use, textures.numbers).r, 0.0, 1.0);
  if (const auto& use = material.film_thickness_texture)
    point.film.thickness = std::lerp(material.film_min_thickness, material.film_thickness,
                                     std::clamp(value(*use, textures.numbers).g, 0.0, 1.0));
  if (const auto& use = material.emissive_texture)
    point.emission *= glm::max(Rgb(value(*use, textures.colours)), Rgb(0.0));
  if (is_blended(material)) {
    const double covered = std::clamp(point.alpha, 0.0, 1.0);
    point.transmission = 1.0 - covered;
    point.emission *= covered / material.alpha; // the factor's share is in the material's
  }
  return point;
}

} // namespace meninas
