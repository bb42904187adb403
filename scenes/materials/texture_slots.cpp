#include "scenes/materials/texture_slots.h"

#include <algorithm>
#include <cmath>

namespace meninas {

void fold(Material& material, const SlotValues& values) {
  const auto channel = [&](std::size_t slot, int c) {
    return std::clamp((*values[slot])[c], 0.0, 1.0);
  };
  if (values[0])
    material.base_color *= glm::clamp(Rgb(*values[0]), 0.0, 1.0);
  if (values[1]) {
    material.roughness *= channel(1, 1);
    material.metallic *= channel(1, 2);
  }
  if (values[2])
    material.emission *= glm::max(Rgb(*values[2]), 0.0);
  if (values[3])
    material.transmission *= channel(3, 0);
  if (values[4])
    material.thickness *= channel(4, 1);
  if (values[5])
    material.specular *= channel(5, 3);
  if (values[6])
    material.specular_color *= glm::clamp(Rgb(*values[6]), 0.0, 1.0);
  if (values[7])
    material.clear_coat *= channel(7, 0);
  if (values[8])
    material.clear_coat_roughness *= channel(8, 1);
  if (values[10])
    material.sheen_color *= glm::clamp(Rgb(*values[10]), 0.0, 1.0);
  if (values[11])
    material.sheen_roughness *= channel(11, 3);
  if (values[12])
    material.diffuse_transmission *= channel(12, 3);
  if (values[13])
    material.diffuse_transmission_color *= glm::clamp(Rgb(*values[13]), 0.0, 1.0);
  if (values[anisotropy_slot]) {
    material.anisotropy *= channel(anisotropy_slot, 2);
    material.anisotropy_direction =
        turned_by_texel(material.anisotropy_direction, *values[anisotropy_slot]);
  }
  if (values[15])
    material.iridescence *= channel(15, 0);
  if (values[16])
    material.film_thickness =
        std::lerp(material.film_min_thickness, material.film_thickness, channel(16, 1));
  for (std::size_t s = 0; s < texture_slots.size(); ++s)
    if (values[s])
      (material.*texture_slots[s].use).reset();
}

Vec2 turned_by_texel(Vec2 direction, const glm::dvec4& texel) {
  constexpr double least = 0.02; // codes of grey are off by less
  const Vec2 own = 2.0 * Vec2(texel) - 1.0;
  const double length = glm::length(own);
  if (!(length > least))
    return direction;
  return Vec2(direction.x * own.x - direction.y * own.y,
              direction.y * own.x + direction.x * own.y) /
         length;
}

} // namespace meninas
