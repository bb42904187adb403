// The places for textures in a material: as what each is decoded, which channels count, and what a
// texture that says the same everywhere makes of the factors.
#pragma once

#include "scenes/material.h"
#include "scenes/materials/texture_pixels.h"

#include <array>
#include <tuple>

namespace meninas {

struct TextureSlot {
  std::optional<TextureUse> Material::*use;
  TextureContent content;
  glm::bvec4 read; ///< channels that count; of base colours alpha besides
};

inline constexpr std::size_t base_slot = 0;
inline const std::array<TextureSlot, 17> texture_slots{{
    {&Material::base_color_texture, TextureContent::colour, {true, true, true, false}},
    {&Material::metallic_roughness_texture, TextureContent::numbers, {false, true, true, false}},
    {&Material::emissive_texture, TextureContent::colour, {true, true, true, false}},
    {&Material::transmission_texture, TextureContent::numbers, {true, false, false, false}},
    {&Material::thickness_texture, TextureContent::numbers, {false, true, false, false}},
    {&Material::specular_texture, TextureContent::numbers, {false, false, false, true}},
    {&Material::specular_color_texture, TextureContent::colour, {true, true, true, false}},
    {&Material::clear_coat_texture, TextureContent::numbers, {true, false, false, false}},
    {&Material::clear_coat_roughness_texture, TextureContent::numbers, {false, true, false, false}},
    {&Material::normal_texture, TextureContent::numbers, {true, true, true, false}},
    {&Material::sheen_color_texture, TextureContent::colour, {true, true, true, false}},
    {&Material::sheen_roughness_texture, TextureContent::numbers, {false, false, false, true}},
    {&Material::diffuse_transmission_texture, TextureContent::numbers, {false, false, false, true}},
    {&Material::diffuse_transmission_color_texture,
     TextureContent::colour,
     {true, true, true, false}},
    {&Material::anisotropy_texture, TextureContent::numbers, {true, true, true, false}},
    {&Material::iridescence_texture, TextureContent::numbers, {true, false, false, false}},
    {&Material::film_thickness_texture, TextureContent::numbers, {false, true, false, false}},
}};
inline constexpr std::size_t anisotropy_slot = 14;

/// By slot, the value that stands for its texture.
using SlotValues =
    std::array<std::optional<glm::dvec4>, std::tuple_size_v<decltype(texture_slots)>>;

/// Puts them into the factors; their textures are gone.
void fold(Material& material, const SlotValues& values);

/// A direction by tangent and bitangent, turned by that of a texel's red and green from (1, 0), which
/// is none where they are grey (KHR_materials_anisotropy).
Vec2 turned_by_texel(Vec2 direction, const glm::dvec4& texel);

} // namespace meninas
