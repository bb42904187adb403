#include "scenes/materials/bsdf_parameters.h"

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
          material.diffuse_transmission_color};
}

} // namespace meninas
