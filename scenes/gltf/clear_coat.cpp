// KHR_materials_clearcoat. What it does to the material is decided here where no texture has a say,
// and else once textures are known (constant_textures.h).
#include "scenes/materials/clear_coat.h"
#include "scenes/gltf/stages.h"

#include <algorithm>

namespace meninas::gltf {

void read_clear_coat(const Document& document, const Json& extension, Material& material,
                     Findings& findings) {
  material.clear_coat = std::clamp(number_or(extension, "clearcoatFactor", 0.0), 0.0, 1.0);
  material.clear_coat_roughness =
      std::clamp(number_or(extension, "clearcoatRoughnessFactor", 0.0), 0.0, 1.0);
  if (material.clear_coat == 0.0)
    return;
  material.clear_coat_texture =
      read_texture_use(document, extension, "clearcoatTexture", material.name, findings);
  if (material.clear_coat_roughness > 0.0)
    material.clear_coat_roughness_texture =
        read_texture_use(document, extension, "clearcoatRoughnessTexture", material.name, findings);
  if (material.clear_coat_texture || material.clear_coat_roughness_texture ||
      material.metallic_roughness_texture)
    return;
  findings.about(settle_clear_coat(material), material.name);
}

} // namespace meninas::gltf
