#include "scenes/materials/sheen.h"

#include <algorithm>
#include <numbers>

namespace meninas {

double below_sheen(const Bsdf& bsdf, double cosine) {
  return bsdf.sheen == Rgb(0.0)
             ? 1.0
             : 1.0 - largest(bsdf.sheen) * sheen_albedo(bsdf.sheen_roughness, cosine);
}

double mean_below_sheen(const Bsdf& bsdf) {
  return bsdf.sheen == Rgb(0.0)
             ? 1.0
             : 1.0 - largest(bsdf.sheen) * mean_sheen_albedo(bsdf.sheen_roughness);
}

double lobe_below_sheen(const Bsdf& bsdf, double cos_out, double cos_in) {
  return bsdf.sheen == Rgb(0.0) ? 1.0
                                : std::min(below_sheen(bsdf, cos_out), below_sheen(bsdf, cos_in));
}

Rgb sheen_lobe(const Bsdf& bsdf, double cos_out, double cos_in) {
  if (bsdf.sheen == Rgb(0.0))
    return Rgb(0.0);
  const double r = bsdf.sheen_roughness;
  return bsdf.sheen * (sheen_albedo(r, cos_out) * sheen_albedo(r, cos_in) /
                       (std::numbers::pi * mean_sheen_albedo(r)));
}

std::string settle_sheen(Material& material) {
  const bool varies = material.sheen_color_texture || material.sheen_roughness_texture;
  material.sheen_color_texture.reset();
  material.sheen_roughness_texture.reset();
  return varies ? "textures of sheen that vary are left out in materials" : "";
}

} // namespace meninas
