#include "scenes/materials/constant_textures.h"

#include "scenes/materials/clear_coat.h"
#include "scenes/materials/sheen.h"
#include "scenes/materials/coverage.h"
#include "scenes/surfaces/disjoint_sets.h"
#include "scenes/gltf/document.h"
#include "scenes/materials/smooth_surfaces.h"
#include "scenes/materials/texel_ranges.h"
#include "scenes/materials/texture_slots.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace meninas {

namespace {

using Slot = TextureSlot;
const auto& slots = texture_slots;

/// sRGB, and beyond white as it goes on.
float stored(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear
                              : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

AllowedRange constant(const Slot& slot) {
  return [slot](const glm::vec4& low, const glm::vec4& high) {
    constexpr float most = static_cast<float>((constant_codes + 0.25) / 255.0); // and rounding
    if (slot.use == &Material::normal_texture &&
        glm::any(glm::greaterThan(glm::abs(glm::vec2(low) - 0.5F), glm::vec2(most))))
      return false;
    for (int c = 0; c < 4; ++c) {
      if (!slot.read[c] || low[c] == high[c])
        continue;
      const bool colour = slot.content == TextureContent::colour && c < 3;
      if (!(colour ? stored(high[c]) - stored(low[c]) <= most : high[c] - low[c] <= most))
        return false;
    }
    return true;
  };
}

glm::dvec4 value_of(const TexelRange& range) {
  glm::dvec4 value = range.sum / std::max(range.count, 1.0);
  for (int c = 0; c < 4; ++c) {
    if (range.low[c] <= 0.0F)
      value[c] = 0.0;
    else if (range.low[c] <= 1.0F && range.high[c] >= 1.0F)
      value[c] = 1.0;
    else if (range.low[c] == range.high[c])
      value[c] = double{range.low[c]};
  }
  return value;
}

using Values = SlotValues;

bool any(const Values& values) {
  return std::ranges::any_of(values, [](const auto& value) { return value.has_value(); });
}

/// Whether there is something to settle that is gone afterwards.
bool has_unsettled_coat(const Material& material) {
  return material.clear_coat > 0.0 || material.specular_texture ||
         material.specular_color_texture || material.clear_coat_texture ||
         material.clear_coat_roughness_texture || material.sheen_color_texture ||
         material.sheen_roughness_texture;
}

/// What is no factor by now is left out.
void settle_coat(Material& material, gltf::Findings& findings) {
  if (material.specular_texture || material.specular_color_texture)
    findings.about("textures of specular reflection that vary are left out in materials",
                   material.name);
  if (material.clear_coat > 0.0 &&
      (material.clear_coat_texture || material.clear_coat_roughness_texture))
    findings.about("textures of clear coats that vary are left out in materials", material.name);
  for (auto* use : {&material.specular_texture, &material.specular_color_texture,
                    &material.clear_coat_texture, &material.clear_coat_roughness_texture})
    use->reset();
  for (const std::string& told : {settle_clear_coat(material), settle_sheen(material)})
    if (!told.empty())
      findings.about(told, material.name);
}

using Triangles = std::vector<TriangleId>;

class Folding {
public:
  Folding(Scene& scene, const DecodedTextures& textures) : scene_(scene), textures_(textures) {}

  const std::vector<std::uint8_t>& nearly_smooth() const { return nearly_smooth_; }
  std::vector<std::string> findings() const { return findings_.lines(); }

  bool run() {
    std::vector<Triangles> of_material(scene_.materials.size());
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
      const MaterialId material = scene_.triangles[t].material;
      if (is_textured(scene_.materials[index(material)]) ||
          scene_.materials[index(material)].normal_texture ||
          has_unsettled_coat(scene_.materials[index(material)]))
        of_material[index(material)].push_back(TriangleId{t});
    }
    for (std::size_t m = 0; m < of_material.size(); ++m)
      if (!of_material[m].empty())
        fold_material(m, of_material[m]);
    return changed_;
  }

private:
  static constexpr std::int64_t max_work = 20'000'000;
  static constexpr std::size_t max_copies = 64;

  const TexelRanges& ranges_of(const TextureUse& use, TextureContent content) {
    const auto& list = content == TextureContent::colour ? textures_.colours : textures_.numbers;
    const TexturePixels& pixels = list[index(use.texture)];
    return ranges_
        .try_emplace({index(use.texture), content}, pixels,
                     scene_.textures[index(use.texture)])
        .first->second;
  }

  std::array<Vec2, 3> texcoords(TriangleId triangle, const TextureUse& use) const {
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId vertex = scene_.triangles[index(triangle)].vertices[k];
      uv[k] = transformed_texcoord(
          use,
          Vec2(attributes_of(scene_, vertex).texcoord[static_cast<std::size_t>(use.texcoord_set)]));
    }
    return uv;
  }

  /// Whether a few points tell that not all texels are allowed: most textures are no constants,
  /// and their pyramids need not be made.
  bool differs(const TextureUse& use, TextureContent content, const Triangles& triangles,
               const AllowedRange& allowed) const {
    constexpr std::size_t max_looks = 16;
    const auto& list = content == TextureContent::colour ? textures_.colours : textures_.numbers;
    const TexturePixels& pixels = list[index(use.texture)];
    if (pixels.texels.empty())
      return true;
    const Texture& texture = scene_.textures[index(use.texture)];
    TexelRange range;
    const auto look = [&](Vec2 uv) {
      const glm::vec4 value(texture_value(pixels, texture, uv));
      range.low = glm::min(range.low, value);
      range.high = glm::max(range.high, value);
    };
    const std::size_t stride = (triangles.size() + max_looks - 1) / max_looks;
    for (std::size_t k = 0; k < triangles.size(); k += stride) {
      const auto uv = texcoords(triangles[k], use);
      for (const Vec2 corner : uv)
        look(corner);
      look((uv[0] + uv[1] + uv[2]) / 3.0);
    }
    return !allowed(range.low, range.high);
  }

  /// The texels that triangles show, if all are allowed.
  std::optional<TexelRange> range(const TextureUse& use, TextureContent content,
                                  const Triangles& triangles, const AllowedRange& allowed) {
    if (differs(use, content, triangles, allowed))
      return std::nullopt;
    const TexelRanges& ranges = ranges_of(use, content);
    TexelRange range;
    for (const TriangleId triangle : triangles)
      if (!ranges.add(texcoords(triangle, use), allowed, range, work_))
        return std::nullopt;
    return range;
  }

  Values constants(const Material& material, const Triangles& triangles) {
    Values values;
    for (std::size_t s = 0; s < slots.size(); ++s) {
      const auto& use = material.*slots[s].use;
      if (!use || (s == base_slot && material.alpha_mode != AlphaMode::opaque))
        continue;
      if (s == anisotropy_slot && textures_.numbers[index(use->texture)].stands_in) {
        values[s] = {1.0, 0.5, 1.0, 1.0}; // white would be a direction
        continue;
      }
      if (const auto found = range(*use, slots[s].content, triangles, constant(slots[s])))
        values[s] = value_of(*found);
    }
    return values;
  }

  bool has_clear_vertex(const Triangles& triangles) const {
    return std::ranges::any_of(triangles, [&](TriangleId t) {
      return std::ranges::any_of(scene_.triangles[index(t)].vertices, [&](VertexId v) {
        return attributes_of(scene_, v).color.a < 1.0F;
      });
    });
  }

  /// A cut-out without holes.
  bool has_no_hole(const Material& material, const Triangles& triangles) {
    if (material.alpha_mode != AlphaMode::mask || !material.base_color_texture)
      return false;
    return !has_clear_vertex(triangles) &&
           range(*material.base_color_texture, TextureContent::colour, triangles,
                 [&](const glm::vec4& low, const glm::vec4&) {
                   return material.alpha * double{low.a} >= material.alpha_cutoff;
                 })
               .has_value();
  }

  /// What is blended by a texture is opaque where that leaves nothing open, a cut-out where it
  /// is an outline, and else open in part.
  void settle_blending(Material& material, const Triangles& triangles) {
    constexpr double outline = 0.1; // of the texels: as many as a leaf's antialiased edge has
    if (!is_blended(material) || !material.base_color_texture)
      return;
    const auto& pixels = textures_.colours[index(material.base_color_texture->texture)];
    const Material blended = material;
    material.transmission = 0.0;
    material.alpha_mode = AlphaMode::mask;
    material.alpha_cutoff = 0.995;
    if (has_no_hole(material, triangles))
      material.alpha_mode = AlphaMode::opaque;
    else if (partly_covered_share(pixels, material.alpha) < outline && !has_clear_vertex(triangles))
      material.alpha_cutoff = 0.5;
    else
      (material = blended).double_sided = true;
    changed_ = true;
  }

  void fold_material(std::size_t m, const Triangles& triangles) {
    settle_blending(scene_.materials[m], triangles);
    if (has_no_hole(scene_.materials[m], triangles)) {
      scene_.materials[m].alpha_mode = AlphaMode::opaque;
      changed_ = true;
    }
    const Values values = constants(scene_.materials[m], triangles);
    if (any(values)) {
      fold(scene_.materials[m], values);
      changed_ = true;
    }
    if (has_unsettled_coat(scene_.materials[m])) {
      settle_coat(scene_.materials[m], findings_);
      changed_ = true;
    }
    if (has_deciding_texture(scene_.materials[m]))
      fold_parts(m, triangles);
    if (is_nearly_smooth(scene_.materials[m], triangles)) {
      nearly_smooth_.resize(scene_.materials.size(), 0);
      nearly_smooth_[m] = 1;
      changed_ = true;
    }
  }

  /// A metal all over, of one colour, whose roughness varies little about a smooth mean.
  bool is_nearly_smooth(const Material& material, const Triangles& triangles) {
    const auto& use = material.metallic_roughness_texture;
    if (!use || material.base_color_texture || material.metallic == 0.0 ||
        material.anisotropy > 0.0)
      return false;
    const auto found =
        range(*use, TextureContent::numbers, triangles,
              [](const glm::vec4& low, const glm::vec4& high) {
                constexpr float most = static_cast<float>((nearly_constant_codes + 0.25) / 255.0);
                return low.b >= 1.0F && high.g - low.g <= most;
              });
    return found && found->count > 0.0 &&
           material.roughness * found->sum.g / found->count <= smooth_metal_roughness;
  }

  static bool has_deciding_texture(const Material& material) {
    return material.metallic_roughness_texture || material.emissive_texture ||
           material.transmission_texture ||
           (material.base_color_texture && material.metallic > 0.0);
  }

  /// Triangles that hang together by vertices.
  std::vector<Triangles> parts_of(const Triangles& triangles) {
    if (!sets_) {
      sets_.emplace(scene_.vertices.size());
      for (const Triangle& triangle : scene_.triangles) {
        sets_->join(index(triangle.vertices[0]), index(triangle.vertices[1]));
        sets_->join(index(triangle.vertices[0]), index(triangle.vertices[2]));
      }
    }
    std::map<std::uint32_t, std::size_t> places;
    std::vector<Triangles> parts;
    for (const TriangleId t : triangles) {
      const auto root = sets_->root(index(scene_.triangles[index(t)].vertices[0]));
      const auto [place, is_new] = places.try_emplace(root, parts.size());
      if (is_new)
        parts.emplace_back();
      parts[place->second].push_back(t);
    }
    return parts;
  }

  void fold_parts(std::size_t m, const Triangles& triangles) {
    const std::vector<Triangles> parts = parts_of(triangles);
    if (parts.size() < 2)
      return;
    std::vector<std::pair<Values, MaterialId>> copies;
    for (const Triangles& part : parts) {
      if (work_ < 0)
        return;
      const Material& material = scene_.materials[m];
      const Values values = constants(material, part);
      const bool decides = values[1] || values[2] || values[3] ||
                           (values[base_slot] && material.metallic > 0.0);
      if (!decides)
        continue;
      const auto known =
          std::ranges::find(copies, values, &std::pair<Values, MaterialId>::first);
      MaterialId id = known != copies.end() ? known->second : none<MaterialId>;
      if (known == copies.end()) {
        if (copies.size() == max_copies)
          continue;
        Material copy = material;
        fold(copy, values);
        id = static_cast<MaterialId>(scene_.materials.size());
        scene_.materials.push_back(std::move(copy));
        copies.emplace_back(values, id);
      }
      for (const TriangleId t : part)
        scene_.triangles[index(t)].material = id;
      changed_ = true;
    }
  }

  Scene& scene_;
  const DecodedTextures& textures_;
  std::map<std::pair<std::uint32_t, TextureContent>, TexelRanges> ranges_;
  std::optional<DisjointSets> sets_; ///< vertices of the scene, once they are asked for
  std::int64_t work_ = max_work;
  std::vector<std::uint8_t> nearly_smooth_; ///< by MaterialId
  gltf::Findings findings_;
  bool changed_ = false;
};

/// Pixels that no material reads are given back.
void drop_unused(const Scene& scene, DecodedTextures& textures) {
  std::vector<std::uint8_t> colours(textures.colours.size(), 0), numbers(textures.numbers.size(), 0);
  for (const Material& material : scene.materials)
    for (const Slot& slot : slots)
      if (const auto& use = material.*slot.use)
        (slot.content == TextureContent::colour ? colours : numbers)[index(use->texture)] = 1;
  for (std::size_t t = 0; t < colours.size(); ++t)
    if (colours[t] == 0)
      textures.colours[t] = {};
  for (std::size_t t = 0; t < numbers.size(); ++t)
    if (numbers[t] == 0)
      textures.numbers[t] = {};
}

} // namespace

std::vector<std::string> fold_constant_textures(Scene& scene, DecodedTextures& textures) {
  Folding folding(scene, textures);
  if (!folding.run())
    return {};
  mark_smooth_surfaces(scene, folding.nearly_smooth());
  drop_unused(scene, textures);
  return folding.findings();
}

} // namespace meninas
