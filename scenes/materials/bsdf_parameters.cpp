#include "scenes/materials/bsdf_parameters.h"

#include <algorithm>
#include <cmath>

namespace meninas {

MaterialPoint untextured(const Material& material) {
  const double passed = is_blended(material) ? 1.0 - material.alpha : material.transmission;
  return {material.base_color,
          material.alpha,
          material.metallic,
          material.roughness,
          material.emission,
          passed,
          material.thickness,
          material.diffuse_transmission,
          material.diffuse_transmission_color,
          material.anisotropy,
          material.anisotropy_direction,
          film_of(material)};
}

/// What is smooth across the axis counts as `ideal_mirror_roughness` there.
static void stretch_facets(const MaterialPoint& point, Bsdf& bsdf) {
  constexpr double least = ideal_mirror_roughness * ideal_mirror_roughness;
  const double across = bsdf.roughness * bsdf.roughness;
  const double along = std::lerp(across, 1.0, point.anisotropy * point.anisotropy);
  if (along <= least)
    return;
  bsdf.alpha = std::max(across, least);
  bsdf.stretch = along / bsdf.alpha;
  bsdf.roughness = std::sqrt(bsdf.alpha * std::sqrt(bsdf.stretch));
  bsdf.axis = point.anisotropy_direction;
}

static void lay_film(const MaterialPoint& point, double metal, Bsdf& bsdf) {
  bsdf.film = point.film;
  if (metal > 0.0) {
    bsdf.metal_below = point.base_color;
    bsdf.metal_with_film = below_film(point.film, point.base_color,
                                      mean_of_film(point.film, point.base_color).reflectance);
    bsdf.metal += metal * (bsdf.metal_with_film - point.base_color);
  }
  if (bsdf.coat > 0.0) {
    const FilmMean mean = mean_of_film(point.film, bsdf.coat_f0 / bsdf.coat_f90);
    bsdf.film_on_coat = {bsdf.coat_f90 * mean.reflectance, bsdf.coat_f90 * mean.largest};
  }
}

Rgb metal_reflectance(const Bsdf& bsdf, double cosine) {
  if (bsdf.film.share == 0.0 || bsdf.metal == Rgb(0.0))
    return bsdf.metal;
  // Whoever has changed the mean has changed it at every angle alike.
  const Rgb at = below_film(bsdf.film, bsdf.metal_below,
                            film_reflectance(bsdf.film, bsdf.metal_below, cosine));
  return bsdf.metal * at / glm::max(bsdf.metal_with_film, Rgb(1e-12));
}

Rgb film_over_coat(const Bsdf& bsdf, double cosine) {
  if (bsdf.coat_f90 == 0.0)
    return Rgb(0.0);
  return bsdf.coat_f90 * film_reflectance(bsdf.film, bsdf.coat_f0 / bsdf.coat_f90, cosine);
}

Bsdf make_bsdf(const Material& material, const MaterialPoint& point) {
  Bsdf bsdf;
  const bool blended = is_blended(material);
  const double dielectric = 1.0 - point.metallic;
  const double covered = blended ? 1.0 - point.transmission : 1.0;
  bsdf.metal = point.base_color * (point.metallic * covered) + point.metal_covariance * covered;
  const double even = dielectric * (1.0 - point.transmission);
  bsdf.diffuse = point.base_color * (even * (1.0 - point.diffuse_transmission));
  if (point.metal_covariance != Rgb(0.0)) {
    // What metal takes of the colour the rest has not.
    const double left = (1.0 - point.transmission) * (1.0 - point.diffuse_transmission);
    bsdf.diffuse = glm::max(bsdf.diffuse - point.metal_covariance * left, Rgb(0.0));
  }
  bsdf.passed = point.diffuse_transmission_color * (even * point.diffuse_transmission);
  const bool solid = is_solid_glass(material);
  bsdf.roughness = solid && point.transmission > 0.0 ? 0.0 : point.roughness;
  bsdf.alpha = bsdf.roughness <= ideal_mirror_roughness ? 0.0 : bsdf.roughness * bsdf.roughness;
  // KHR_materials_ior and KHR_materials_specular; ior 0 stands for F0 = 1.
  const double ratio = (material.ior - 1.0) / (material.ior + 1.0);
  const Rgb f0 = glm::min(ratio * ratio * material.specular_color, Rgb(1.0)) * material.specular;
  if (bsdf.roughness <= visible_coat_roughness) {
    bsdf.coat_f0 = f0;
    bsdf.coat_f90 = material.specular;
    bsdf.coat = material.specular > 0.0 ? dielectric * (1.0 - point.transmission) : 0.0;
  }
  if (point.film.share > 0.0)
    lay_film(point, point.metallic * covered, bsdf);
  if (point.anisotropy > 0.0 && !(solid && point.transmission > 0.0))
    stretch_facets(point, bsdf);
  if (point.transmission == 0.0) {
    bsdf.sheen = material.sheen_color;
    bsdf.sheen_roughness = material.sheen_roughness;
  }
  bsdf.glass = blended ? point.transmission : dielectric * point.transmission;
  if (blended)
    bsdf.pane.faces = GlassFaces::none;
  else if (bsdf.glass > 0.0)
    bsdf.pane = {material.ior, f0, material.specular, point.base_color,
                 solid ? GlassFaces::one : GlassFaces::both, point.film};
  return bsdf;
}

} // namespace meninas
