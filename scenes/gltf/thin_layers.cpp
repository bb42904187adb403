// What materials have over them or in them beyond metal and roughness: cloth that light comes
// through, sheen, a thin film, brushed metal, glass that splits colours.
#include "scenes/gltf/stages.h"

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

/// KHR_materials_sheen, of what is opaque (sheen.h).
static void read_sheen(const Document& document, const Json& extension, Material& material,
                       Findings& findings) {
  const auto color = vec3_or(extension, "sheenColorFactor", Rgb(0.0));
  material.sheen_color = glm::clamp(color, 0.0, 1.0);
  material.sheen_roughness = std::clamp(number_or(extension, "sheenRoughnessFactor", 0.0), 0.0, 1.0);
  if (material.sheen_color != color)
    findings.about("sheen colours were clamped to [0, 1] in materials", material.name);
  if (material.sheen_color == Rgb(0.0))
    return;
  material.sheen_color_texture =
      read_texture_use(document, extension, "sheenColorTexture", material.name, findings);
  if (material.sheen_roughness > 0.0)
    material.sheen_roughness_texture =
        read_texture_use(document, extension, "sheenRoughnessTexture", material.name, findings);
}

/// KHR_materials_diffuse_transmission: a translucent surface (material.h).
static void read_diffuse_transmission(const Document& document, const Json& extension,
                                      Material& material, Findings& findings) {
  const auto factor = number_or(extension, "diffuseTransmissionFactor", 0.0);
  const auto color = vec3_or(extension, "diffuseTransmissionColorFactor", Rgb(1.0));
  material.diffuse_transmission = std::clamp(factor, 0.0, 1.0);
  material.diffuse_transmission_color = glm::clamp(color, 0.0, 1.0);
  if (material.diffuse_transmission != factor || material.diffuse_transmission_color != color)
    findings.about("diffuse transmission was clamped to [0, 1] in materials", material.name);
  if (material.diffuse_transmission == 0.0)
    return;
  material.diffuse_transmission_texture =
      read_texture_use(document, extension, "diffuseTransmissionTexture", material.name, findings);
  material.diffuse_transmission_color_texture = read_texture_use(
      document, extension, "diffuseTransmissionColorTexture", material.name, findings);
}

/// Nanometres, beyond which no interference is left to be seen.
static constexpr double thickest_film = 1e5;

/// KHR_materials_iridescence (thin_film.h). What has no reflection to show it with has no film.
static void read_iridescence(const Document& document, const Json& extension, Material& material,
                             Findings& findings) {
  const auto factor = number_or(extension, "iridescenceFactor", 0.0);
  const auto ior = number_or(extension, "iridescenceIor", 1.3);
  const auto least = number_or(extension, "iridescenceThicknessMinimum", 100.0);
  const auto most = number_or(extension, "iridescenceThicknessMaximum", 400.0);
  material.iridescence = std::clamp(factor, 0.0, 1.0);
  material.film_ior = std::clamp(ior, 1.0, 5.0);
  material.film_min_thickness = std::clamp(least, 0.0, thickest_film);
  material.film_thickness = std::clamp(most, 0.0, thickest_film);
  if (material.iridescence == 0.0)
    return;
  if (material.iridescence != factor || material.film_ior != ior ||
      material.film_min_thickness != least || material.film_thickness != most)
    findings.about("factors of iridescence out of range were clamped in materials", material.name);
  const bool is_matt = material.metallic == 0.0 && material.transmission == 0.0 &&
                       (material.roughness > visible_coat_roughness || material.specular == 0.0);
  if (is_matt && !material.metallic_roughness_texture) {
    findings.about("iridescence of what is matt is left out in materials", material.name);
    material.iridescence = 0.0;
    return;
  }
  material.iridescence_texture =
      read_texture_use(document, extension, "iridescenceTexture", material.name, findings);
  material.film_thickness_texture =
      read_texture_use(document, extension, "iridescenceThicknessTexture", material.name, findings);
}

/// KHR_materials_anisotropy (material.h).
static void read_anisotropy(const Document& document, const Json& extension, Material& material,
                            Findings& findings) {
  const auto strength = number_or(extension, "anisotropyStrength", 0.0);
  material.anisotropy = std::clamp(strength, 0.0, 1.0);
  if (material.anisotropy != strength)
    findings.about("strengths of anisotropy were clamped to [0, 1] in materials", material.name);
  if (material.anisotropy == 0.0)
    return;
  const auto rotation = number_or(extension, "anisotropyRotation", 0.0);
  material.anisotropy_direction = {std::cos(rotation), std::sin(rotation)};
  material.anisotropy_texture =
      read_texture_use(document, extension, "anisotropyTexture", material.name, findings);
}

void read_thin_layers(const Document& document, const Json& json, Material& material,
                      Findings& findings) {
  const auto* extensions = find(json, "extensions");
  if (!extensions)
    return;
  if (const auto* sheet = find(*extensions, "KHR_materials_diffuse_transmission"))
    read_diffuse_transmission(document, *sheet, material, findings);
  if (const auto* sheen = find(*extensions, "KHR_materials_sheen"))
    read_sheen(document, *sheen, material, findings);
  if (const auto* iridescence = find(*extensions, "KHR_materials_iridescence"))
    read_iridescence(document, *iridescence, material, findings);
  if (const auto* anisotropy = find(*extensions, "KHR_materials_anisotropy"))
    read_anisotropy(document, *anisotropy, material, findings);
  const auto* dispersion = find(*extensions, "KHR_materials_dispersion");
  if (dispersion && number_or(*dispersion, "dispersion", 0.0) > 0.0 && is_glass(material))
    findings.about("dispersion is left out, all colours are refracted by the ior, in materials",
                   material.name);
}

/// A translucent surface is there from both sides. What would pass into a solid is none.
static void settle_diffuse_transmission(Material& material, Findings& findings) {
  if (is_solid_glass(material) && material.diffuse_transmission > 0.0) {
    findings.about("diffuse transmission into solid glass is left out in materials", material.name);
    material.diffuse_transmission = 0.0;
    material.diffuse_transmission_texture.reset();
    material.diffuse_transmission_color_texture.reset();
  }
  if (is_translucent(material))
    material.double_sided = true;
}

void settle_thin_layers(Material& material, Findings& findings) {
  settle_diffuse_transmission(material, findings);
  if (material.sheen_color == Rgb(0.0) || !is_glass(material))
    return;
  findings.about("sheen of what light passes is left out in materials", material.name);
  material.sheen_color = Rgb(0.0);
  material.sheen_color_texture.reset();
  material.sheen_roughness_texture.reset();
}

} // namespace meninas::gltf
