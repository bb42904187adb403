#include "scenes/material.h"

#include <cmath>

namespace meninas {

/// Texels say where it is metal and how smooth: no mirror of one reflectance.
/// Those of glass are read wherever light meets it.
static bool has_texels_of_metal(const Material& material) {
  return material.metallic_roughness_texture && !is_glass(material);
}

double widest_roughness(const Material& material) {
  if (material.anisotropy == 0.0)
    return material.roughness;
  const double along = material.anisotropy * material.anisotropy;
  return std::sqrt(std::lerp(material.roughness * material.roughness, 1.0, along));
}

bool is_mirror(const Material& material) {
  const bool is_smooth =
      widest_roughness(material) <= ideal_mirror_roughness && !has_texels_of_metal(material);
  return material.metallic > 0.0 && !is_blended(material) &&
         (is_smooth || material.specular_in_pass_one) &&
         (glm::any(glm::greaterThan(material.base_color, Rgb(0.0))) || material.iridescence > 0.0);
}

bool has_mirror_coat(const Material& material) {
  return material.specular_in_pass_one && material.metallic == 0.0;
}

bool is_emitter(const Material& material) {
  return glm::any(glm::greaterThan(material.emission, Rgb(0.0)));
}

bool is_glossy(const Material& material) {
  return material.metallic > 0.0 &&
         (widest_roughness(material) > ideal_mirror_roughness || has_texels_of_metal(material));
}

bool is_blended(const Material& material) {
  return material.alpha_mode == AlphaMode::blend && material.transmission > 0.0;
}

bool is_glass(const Material& material) {
  return material.transmission > 0.0 &&
         (material.metallic < 1.0 || material.metallic_roughness_texture || is_blended(material));
}

bool is_translucent(const Material& material) {
  return material.diffuse_transmission > 0.0 && material.diffuse_transmission_color != Rgb(0.0) &&
         (material.metallic < 1.0 || material.metallic_roughness_texture);
}

bool is_solid_glass(const Material& material) {
  return is_glass(material) && material.thickness > 0.0 && !is_blended(material);
}

ThinFilm film_of(const Material& material) {
  if (material.iridescence == 0.0)
    return {};
  const double thickness = material.film_thickness_texture
                               ? 0.5 * (material.film_min_thickness + material.film_thickness)
                               : material.film_thickness;
  return {material.film_ior, thickness, material.iridescence};
}

} // namespace meninas
