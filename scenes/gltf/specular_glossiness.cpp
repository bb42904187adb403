// KHR_materials_pbrSpecularGlossiness, which older exporters write,
// as a material of the metallic-roughness model.
//
// Its diffuse reflectance d and specular reflectance s at normal incidence are those
// of one surface. A dielectric reflects about 4 % and metals, which have no d, more.
// With c the base colour and m how metallic it is, the model says d = c (1 - m) and s = 0.04
// (1 - m) + c m; without c the brightest channels leave a quadratic equation for m.
#include "scenes/gltf/stages.h"

#include <algorithm>
#include <cmath>

namespace meninas::gltf {

static constexpr double dielectric = 0.04;

/// m of the quadratic f0 m² + (d (1 - max s) / (1 - f0) + s - 2 f0) m + f0 - s = 0.
static double metallic_of(double diffuse, double specular, double reflected) {
  if (specular < dielectric)
    return 0.0;
  const auto b = diffuse * (1.0 - reflected) / (1.0 - dielectric) + specular - 2.0 * dielectric;
  const auto c = dielectric - specular;
  const auto root = std::sqrt(std::max(b * b - 4.0 * dielectric * c, 0.0));
  return std::clamp((-b + root) / (2.0 * dielectric), 0.0, 1.0);
}

void read_specular_glossiness(const Document& document, const Json& model, Material& material,
                              Findings& findings) {
  const auto factor = numbers_at(model, "diffuseFactor");
  const auto diffuse = glm::clamp(vec3_or(model, "diffuseFactor", Rgb(1.0)), 0.0, 1.0);
  const auto specular = glm::clamp(vec3_or(model, "specularFactor", Rgb(1.0)), 0.0, 1.0);
  const auto glossiness = std::clamp(number_or(model, "glossinessFactor", 1.0), 0.0, 1.0);
  material.alpha = factor.empty() ? 1.0 : std::clamp(factor[3], 0.0, 1.0);
  material.roughness = 1.0 - glossiness;
  material.base_color_texture =
      read_texture_use(document, model, "diffuseTexture", material.name, findings);
  findings.about("specular-glossiness materials are read as metallic-roughness", material.name);

  // What is reflected is in the texture, texel by texel;
  // the factor alone, usually 1, would make everything a mirror.
  if (model.contains("specularGlossinessTexture")) {
    findings.about("specular-glossiness textures are left out, materials are matt", material.name);
    material.base_color = diffuse;
    material.metallic = 0.0;
    material.roughness = 1.0;
    return;
  }
  const auto metallic = metallic_of(largest(diffuse), largest(specular), largest(specular));
  const auto from_diffuse =
      diffuse * (1.0 - largest(specular)) / (1.0 - dielectric) / std::max(1.0 - metallic, 1e-6);
  const auto from_specular = (specular - dielectric * (1.0 - metallic)) / std::max(metallic, 1e-6);
  material.metallic = metallic;
  material.base_color =
      glm::clamp(glm::mix(from_diffuse, from_specular, metallic * metallic), 0.0, 1.0);
}

} // namespace meninas::gltf
