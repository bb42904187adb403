#include "scenes/materials/coverage.h"

namespace meninas {

double coverage(const Material& material, const MaterialPoint& point) {
  return is_blended(material) ? 1.0 - point.transmission : 1.0;
}

double partly_covered_share(const TexturePixels& pixels, double alpha) {
  constexpr double there_at_all = 0.1, all_there = 0.98;
  std::size_t there = 0, partly = 0;
  for (const glm::vec4& texel : pixels.texels) {
    const double covered = alpha * double{texel.a};
    there += covered > there_at_all ? 1 : 0;
    partly += covered > there_at_all && covered < all_there ? 1 : 0;
  }
  return there > 0 ? double(partly) / double(there) : 1.0;
}

Rgb shown_radiance(const Material& material, const MaterialPoint& point) {
  return material.unlit ? coverage(material, point) * point.base_color : point.emission;
}

} // namespace meninas
