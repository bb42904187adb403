// The places for textures in a material: as what each is decoded, and which channels count.
#pragma once

#include "scenes/material.h"
#include "scenes/materials/texture_pixels.h"

#include <array>

namespace meninas {

struct TextureSlot {
  std::optional<TextureUse> Material::*use;
  TextureContent content;
  glm::bvec4 read; ///< channels that count; of base colours alpha besides
};

inline constexpr std::size_t base_slot = 0;
inline const std::array<TextureSlot, 14> texture_slots{{
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
}};

} // namespace meninas
