// KHR_materials_clearcoat, a layer of lacquer over a material,
// as far as there is one layer to show it with.
//
// A dielectric has a coat of its own (material.h), and lacquer has the same index of refraction,
// 1.5. Over matt paint the lacquer's reflection is the one that is seen: it takes the place of the
// paint's own, factor by factor. Metals under lacquer have two reflections; they keep their own.
#include "scenes/gltf_stages.h"

#include <algorithm>

namespace meninas::gltf {

void read_clear_coat(const Json& extension, Material& material, Findings& findings) {
  const double coat = std::clamp(number_or(extension, "clearcoatFactor", 0.0), 0.0, 1.0);
  const double roughness =
      std::clamp(number_or(extension, "clearcoatRoughnessFactor", 0.0), 0.0, 1.0);
  if (coat == 0.0)
    return;
  const bool is_paint = material.metallic == 0.0 && material.transmission == 0.0 &&
                        !material.metallic_roughness_texture;
  if (!is_paint || material.roughness <= roughness) {
    findings.about(
        "clear coats of metals, glass and what is as smooth itself are left out in materials",
        material.name);
    return;
  }
  material.roughness = roughness;
  material.ior = 1.5;
  material.specular = coat;
  material.specular_color = Rgb(1.0);
  findings.about("clear coats are shown in place of the gloss below them in materials",
                 material.name);
  if (extension.contains("clearcoatTexture") || extension.contains("clearcoatRoughnessTexture"))
    findings.about("textures of clear coats are left out in materials", material.name);
}

} // namespace meninas::gltf
