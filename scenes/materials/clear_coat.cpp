#include "scenes/materials/clear_coat.h"

#include <utility>

namespace meninas {

std::string settle_clear_coat(Material& material) {
  const double coat = std::exchange(material.clear_coat, 0.0);
  const double roughness = std::exchange(material.clear_coat_roughness, 0.0);
  if (coat == 0.0)
    return {};
  const bool is_paint = material.metallic == 0.0 && material.transmission == 0.0 &&
                        !material.metallic_roughness_texture;
  if (!is_paint || material.roughness <= roughness)
    return "clear coats of metals, glass and what is as smooth itself are left out in materials";
  material.roughness = roughness;
  material.anisotropy = 0.0;
  material.anisotropy_texture.reset();
  material.iridescence = 0.0;
  material.iridescence_texture.reset();
  material.film_thickness_texture.reset();
  material.ior = 1.5;
  material.specular = coat;
  material.specular_color = Rgb(1.0);
  return "clear coats are shown in place of the gloss below them in materials";
}

} // namespace meninas
