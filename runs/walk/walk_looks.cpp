#include "runs/walk/walk_looks.h"

#include "scenes/materials/coverage.h"
#include "scenes/materials/lobes.h"
#include "scenes/materials/bsdf.h"

#include <cmath>

namespace meninas {

namespace {

/// The mean of a texture of numbers; 1 where there is none.
glm::dvec4 mean_of(const DecodedTextures& textures, const std::optional<TextureUse>& use) {
  if (!use || index(use->texture) >= textures.numbers.size())
    return glm::dvec4(1.0);
  const TexturePixels* level = &textures.numbers[index(use->texture)];
  if (!level->coarser.empty())
    level = &level->coarser.back();
  glm::dvec4 sum(0.0);
  for (const glm::vec4& texel : level->texels)
    sum += glm::dvec4(texel);
  return level->texels.empty() ? glm::dvec4(1.0) : sum / double(level->texels.size());
}

/// The factors, those that textures vary with their means.
MaterialPoint mean_point(const DecodedTextures& textures, const Material& material) {
  MaterialPoint point = untextured(material);
  const glm::dvec4 metal = mean_of(textures, material.metallic_roughness_texture);
  point.metallic *= metal.b;
  point.roughness *= metal.g;
  point.transmission *= mean_of(textures, material.transmission_texture).r;
  return point;
}

/// Schlick's F0 of a pane, below a film that which has its mean.
Rgb f0_of_pane(const Glass& pane) {
  if (pane.film.share == 0.0 || pane.f90 == 0.0)
    return pane.f0;
  const Rgb mean = pane.f90 * mean_of_film(pane.film, pane.f0 / pane.f90).reflectance;
  return below_film(pane.film, pane.f0, schlick_f0_of_mean(mean, pane.f90));
}

/// A direction for what hardly depends on it.
Direction from_most_sides() {
  constexpr double cosine = 0.7;
  return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}

/// The share of light that it scatters evenly to the eye, where its lobes are shown by themselves.
Rgb even_part(const Bsdf& bsdf, WalkKind kind) {
  if (kind == WalkKind::coat)
    return bsdf.diffuse;
  return even_reflectance(bsdf, from_most_sides());
}

/// What metal, and the coat of what is not metal, reflect in their lobe, from most sides.
Rgb lobe_reflectance(const Bsdf& bsdf) {
  const SchlickAlbedo albedo = lobe_albedo(bsdf, from_most_sides());
  return bsdf.metal * (albedo.f0 + albedo.f90) + bsdf.coat * coat_albedo(bsdf, from_most_sides());
}

/// What its facets of metal alone spread of light, towards most sides.
Rgb spread_by_metal(Bsdf bsdf) {
  bsdf.diffuse = bsdf.passed = bsdf.sheen = Rgb(0.0);
  bsdf.coat = 0.0;
  return even_reflectance(bsdf, from_most_sides());
}

/// What is worth looking for in a lobe.
bool shows_metal(const Material& material, const MaterialPoint& point) {
  constexpr double least = 0.02; // of the light
  return is_glossy(material) && point.metallic * largest(point.base_color) > least;
}

WalkKind kind_of(const Material& material, const MaterialPoint& point, WalkFace face) {
  if (material.unlit)
    return is_blended(material) ? WalkKind::unlit_covering : WalkKind::unlit;
  if (is_blended(material))
    return WalkKind::covering;
  if (is_solid_glass(material))
    return WalkKind::solid;
  if (is_glass(material))
    return WalkKind::pane;
  if (face == WalkFace::facet)
    return WalkKind::curved;
  if (face == WalkFace::plain)
    return shows_metal(material, point) ? WalkKind::glossy : WalkKind::plain;
  return has_mirror_coat(material) ? WalkKind::coat : WalkKind::mirror;
}

Rgb rho_of(const Material& material, MaterialPoint point, WalkKind kind, const Rgb& colour) {
  point.base_color = colour;
  if (kind == WalkKind::plain || kind == WalkKind::covering)
    return diffuse_reflectance(material, point);
  return even_part(make_bsdf(material, point), kind);
}

} // namespace

WalkLook walk_look(const Scene& scene, const DecodedTextures& textures, MaterialId id,
                   WalkFace face) {
  const Material& material = scene.materials[index(id)];
  MaterialPoint point = mean_point(textures, material);
  WalkLook look;
  look.name = material.name;
  look.kind = kind_of(material, point, face);
  look.roughness = point.roughness;
  look.emission = material.emission;
  if (material.alpha_mode != AlphaMode::opaque)
    look.alpha = material.alpha;
  if (material.alpha_mode == AlphaMode::mask)
    look.cutoff = material.alpha_cutoff;
  if (look.kind == WalkKind::covering) {
    point.transmission = 0.0;
    // The factor's share is in the material's; the page takes all of alpha.
    look.emission = material.alpha > 0.0 ? material.emission / material.alpha : Rgb(0.0);
  }
  if (material.unlit) {
    look.albedo = point.base_color;
    return look;
  }
  look.rest = rho_of(material, point, look.kind, Rgb(0.0));
  look.albedo = rho_of(material, point, look.kind, point.base_color) - look.rest;
  const Bsdf bsdf =
      look.kind == WalkKind::coat ? mirror_coat(material) : make_bsdf(material, point);
  look.reflectance = bsdf.metal;
  // What facets spread is in the even part, of light that only metals with a field receive.
  if (look.kind == WalkKind::glossy) {
    const SchlickAlbedo albedo = lobe_albedo(bsdf, from_most_sides());
    look.reflectance = lobe_reflectance(bsdf);
    look.f0 = spread_by_metal(bsdf);
    look.f90 = albedo.f0 + albedo.f90;
  }
  if (look.kind == WalkKind::coat) {
    look.f0 = bsdf.coat * below_film(bsdf.film, bsdf.coat_f0,
                                     schlick_f0_of_mean(bsdf.film_on_coat.reflectance, bsdf.coat_f90));
    look.f90 = bsdf.coat * bsdf.coat_f90;
  } else if (look.kind == WalkKind::pane || look.kind == WalkKind::solid) {
    look.f0 = f0_of_pane(bsdf.pane);
    look.f90 = bsdf.pane.f90;
    look.ior = bsdf.pane.ior;
    look.tint = bsdf.pane.tint;
    if (look.kind == WalkKind::solid)
      look.reflectance = std::isfinite(material.attenuation_distance)
                             ? glm::log(glm::max(material.attenuation_color, Rgb(1e-300))) /
                                   material.attenuation_distance
                             : Rgb(0.0);
  }
  return look;
}

} // namespace meninas
