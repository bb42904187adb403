#include "scenes/materials/texture_lookup.h"

#include "scenes/materials/texture_pyramid.h"
#include "scenes/materials/texture_slots.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace meninas {

namespace {

/// The texel that index k stands for.
int wrapped(std::int64_t k, int size, Wrap wrap) {
  if (k >= 0 && k < size)
    return static_cast<int>(k);
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
  const int left = wrapped(u.first, pixels.width, texture.wrap_u);
  const int right = wrapped(u.first + 1, pixels.width, texture.wrap_u);
  const auto row = [&](std::int64_t j) {
    const auto y = static_cast<std::size_t>(wrapped(j, pixels.height, texture.wrap_v));
    const glm::vec4* first = pixels.texels.data() + y * static_cast<std::size_t>(pixels.width);
    return glm::mix(glm::dvec4(first[left]), glm::dvec4(first[right]), u.share);
  };
  return glm::mix(row(v.first), row(v.first + 1), v.share);
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

/// How often an image is looked at along the longer side of a footprint, and the texels of a look.
struct Looks {
  Vec2 along{0.0};
  double count = 0.0; ///< 0: the footprint is no larger than a texel
  double width = 0.0;
};

static Looks looks_at(const TexturePixels& pixels, const Footprint& footprint) {
  constexpr double max_looks = 16.0;
  const Vec2 size(pixels.width, pixels.height);
  Vec2 along = footprint.longer;
  double length = glm::length(size * along), width = glm::length(size * footprint.shorter);
  if (length < width) {
    std::swap(length, width);
    along = footprint.shorter;
  }
  if (!(length > 1.0) || !std::isfinite(length))
    return {};
  const double count = std::clamp(std::ceil(length / std::max(width, 1.0)), 1.0, max_looks);
  return {along, count, std::max({width, length / count, 1.0})};
}

/// The mean of all looks, each from the two levels about its width; `at(level, uv)` is a level's value.
template <typename At>
static auto mean_of_looks(const Looks& looks, std::size_t coarsest, Vec2 uv, const At& at) {
  const double level = std::clamp(std::log2(looks.width), 0.0, static_cast<double>(coarsest));
  const auto below = static_cast<std::size_t>(level);
  const double share = level - static_cast<double>(below);
  decltype(at(below, uv)) sum(0.0);
  for (double k = 0.5; k < looks.count; k += 1.0) {
    const Vec2 there = uv + (k / looks.count - 0.5) * looks.along;
    sum += share == 0.0 ? at(below, there) : glm::mix(at(below, there), at(below + 1, there), share);
  }
  return sum / looks.count;
}

/// A point of the image itself.
static glm::dvec4 sharp_value(const TexturePixels& pixels, const Texture& texture, Vec2 uv) {
  return texture.magnified == TexelFilter::nearest ? nearest(pixels, texture, uv)
                                                   : bilinear(pixels, texture, uv);
}

glm::dvec4 texture_value(const TexturePixels& pixels, const Texture& texture, Vec2 uv,
                         const Footprint& footprint) {
  const Looks looks = looks_at(pixels, footprint);
  if (looks.count == 0.0)
    return sharp_value(pixels, texture, uv);
  return mean_of_looks(looks, pixels.coarser.size(), uv, [&](std::size_t k, Vec2 at) {
    return bilinear(k == 0 ? pixels : pixels.coarser[k - 1], texture, at);
  });
}

/// The point of an image that a point of a triangle shows, and the part of it.
struct Shown {
  Vec2 uv;
  Footprint footprint;
};

static Shown shown_at(const Scene& scene, const TextureUse& use, TriangleId triangle,
                      Vec2 barycentric, const Footprint& footprint) {
  const auto place = [&](Vec2 weights) {
    return transformed_texcoord(use, texcoord_at(scene, triangle, use.texcoord_set, weights));
  };
  const Vec2 origin = place(Vec2(0.0)); // the map is affine
  return {place(barycentric), {place(footprint.longer) - origin, place(footprint.shorter) - origin}};
}

glm::dvec4 texel_at(const Scene& scene, const std::vector<TexturePixels>& list,
                    const TextureUse& use, TriangleId triangle, Vec2 barycentric,
                    const Footprint& footprint) {
  const Shown shown = shown_at(scene, use, triangle, barycentric, footprint);
  return texture_value(list[index(use.texture)], scene.textures[index(use.texture)], shown.uv,
                       shown.footprint);
}

/// Whether part of a surface may not be there, as its texture's alpha says.
static bool has_gaps(const Material& material) {
  return material.alpha_mode == AlphaMode::mask || is_blended(material);
}

/// The share w of a texel that is there, by its alpha.
static double weight_of(const Material& material, double alpha) {
  MaterialPoint point;
  point.alpha = material.alpha * alpha;
  if (is_cut_out(material, point))
    return 0.0;
  return is_blended(material) ? std::clamp(point.alpha, 0.0, 1.0) : 1.0;
}

/// A texture of metalness that lies as the base colour's does, so that both vary together.
static bool metal_lies_alike(const Material& material) {
  const auto& base = material.base_color_texture;
  const auto& metal = material.metallic_roughness_texture;
  return base && metal && material.metallic > 0.0 && base->texcoord_set == metal->texcoord_set &&
         base->offset == metal->offset && base->rotation == metal->rotation &&
         base->scale == metal->scale;
}

/// (w c m, w) of a texel.
static glm::dvec4 weighed(const Material& material, const glm::dvec4& base, double metalness) {
  const double weight = weight_of(material, base.a);
  return {glm::clamp(Rgb(base), 0.0, 1.0) * (weight * std::clamp(metalness, 0.0, 1.0)), weight};
}

/// Whether the blue of an image differs by more than two 8-bit codes, as the noise of JPEG does.
static bool blue_varies(const TexturePixels& image) {
  constexpr float alike = 2.5F / 255.0F;
  const auto [least, most] = std::ranges::minmax(image.texels, {}, &glm::vec4::b);
  return most.b - least.b > alike;
}

static WeighedColours weighed_colours(const Scene& scene, const DecodedTextures& textures,
                                      const Material& material) {
  WeighedColours weighed_levels;
  const TexturePixels& base = textures.colours[index(material.base_color_texture->texture)];
  const auto colour_at = [&](int x, int y) {
    return glm::dvec4(base.texels[static_cast<std::size_t>(y) * base.width + x]);
  };
  if (has_gaps(material))
    weighed_levels.base = coarser_levels(base.width, base.height, [&](int x, int y) {
      return glm::vec4(weighed(material, colour_at(x, y), 1.0));
    });
  if (!metal_lies_alike(material))
    return weighed_levels;
  const TextureId id = material.metallic_roughness_texture->texture;
  const TexturePixels& numbers = textures.numbers[index(id)];
  if (!blue_varies(numbers))
    return weighed_levels;

  // The image of metalness may have another size: a texel of the colour has its mean.
  const Vec2 size(1.0 / base.width, 1.0 / base.height);
  const bool same_size = base.width == numbers.width && base.height == numbers.height;
  weighed_levels.metal = coarser_levels(base.width, base.height, [&](int x, int y) {
    const glm::dvec4 there =
        same_size ? glm::dvec4(numbers.texels[static_cast<std::size_t>(y) * base.width + x])
                  : texture_value(numbers, scene.textures[index(id)], size * (Vec2(x, y) + 0.5),
                                  {{size.x, 0.0}, {0.0, size.y}});
    return glm::vec4(weighed(material, colour_at(x, y), there.b));
  });
  return weighed_levels;
}

void weigh_colours(const Scene& scene, DecodedTextures& textures) {
  // What the pyramids depend on: images, and of what has gaps the alpha.
  using Key = std::tuple<TextureId, TextureId, AlphaMode, double, double>;
  std::map<Key, std::shared_ptr<const WeighedColours>> made;
  textures.weighed.assign(scene.materials.size(), nullptr);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const bool gaps = has_gaps(material);
    if (!material.base_color_texture || (!gaps && !metal_lies_alike(material)))
      continue;
    const TextureId metal = metal_lies_alike(material) ? material.metallic_roughness_texture->texture
                                                       : none<TextureId>;
    auto& levels = made[{material.base_color_texture->texture, metal,
                         gaps ? material.alpha_mode : AlphaMode::opaque, gaps ? material.alpha : 1.0,
                         gaps ? material.alpha_cutoff : 0.0}];
    if (!levels)
      levels = std::make_shared<WeighedColours>(weighed_colours(scene, textures, material));
    if (!levels->base.empty() || !levels->metal.empty())
      textures.weighed[m] = levels;
  }
}

/// The base colour of the texture over what is shown of it, and the covariance of it with the metalness of its
/// texture, `metalness` in the mean.
struct MeanColours {
  Rgb base, metal_covariance{0.0};
};

static MeanColours mean_colours(const Scene& scene, const DecodedTextures& textures,
                                MaterialId id, const Shown& shown, const Rgb& plain,
                                double metalness) {
  MeanColours mean{plain};
  if (index(id) >= textures.weighed.size() || !textures.weighed[index(id)])
    return mean;
  const auto& [base_levels, metal_levels] = *textures.weighed[index(id)];
  const Material& material = scene.materials[index(id)];
  const TextureId base_id = material.base_color_texture->texture;
  const TexturePixels& base = textures.colours[index(base_id)];
  const Texture& texture = scene.textures[index(base_id)];
  const Looks looks = looks_at(base, shown.footprint);
  if (looks.count == 0.0)
    return mean;
  const auto mean_of = [&](const std::vector<TexturePixels>& levels, const auto& metalness_at) {
    return mean_of_looks(looks, levels.size(), shown.uv, [&](std::size_t k, Vec2 at) {
      return k == 0 ? weighed(material, bilinear(base, texture, at), metalness_at(at))
                    : bilinear(levels[k - 1], texture, at);
    });
  };
  if (!base_levels.empty())
    if (const auto sum = mean_of(base_levels, [](Vec2) { return 1.0; }); sum.a > 0.0)
      mean.base = Rgb(sum) / sum.a;
  if (!metal_levels.empty()) {
    const TextureId metal_id = material.metallic_roughness_texture->texture;
    const auto sum = mean_of(metal_levels, [&](Vec2 at) {
      return bilinear(textures.numbers[index(metal_id)], scene.textures[index(metal_id)], at).b;
    });
    if (sum.a > 0.0)
      mean.metal_covariance = Rgb(sum) / sum.a - mean.base * metalness;
  }
  return mean;
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
  double metalness = 1.0;
  if (const auto& use = material.metallic_roughness_texture) {
    const glm::dvec4 texel = value(*use, textures.numbers);
    metalness = std::clamp(texel.b, 0.0, 1.0);
    point.roughness *= std::clamp(texel.g, 0.0, 1.0);
    point.metallic *= metalness;
  }
  if (const auto& use = material.base_color_texture) {
    const Shown shown = shown_at(scene, *use, triangle, barycentric, footprint);
    const glm::dvec4 texel = texture_value(textures.colours[index(use->texture)],
                                           scene.textures[index(use->texture)], shown.uv, shown.footprint);
    const MeanColours mean =
        mean_colours(scene, textures, scene.triangles[index(triangle)].material, shown,
                     glm::clamp(Rgb(texel), 0.0, 1.0), metalness);
    point.metal_covariance = material.metallic * point.base_color * mean.metal_covariance;
    point.base_color *= mean.base;
    point.alpha *= texel.a;
  }
  if (has_vertex_colors(scene, triangle)) {
    const glm::dvec4 color = glm::clamp(color_at(scene, triangle, barycentric), 0.0, 1.0);
    point.base_color *= Rgb(color);
    point.metal_covariance *= Rgb(color);
    point.alpha *= color.a;
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
