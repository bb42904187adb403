#include "scenes/materials/glass.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// F of the base alone.
Rgb base_reflectance(const Glass& glass, double cosine) {
  const double normal = fresnel(glass.ior, 1.0);
  if (normal >= 1.0)
    return glass.f0;
  const double rise = std::clamp((fresnel(glass.ior, cosine) - normal) / (1.0 - normal), 0.0, 1.0);
  return glm::mix(glass.f0, Rgb(glass.f90), rise);
}

/// The cosine in the air: what leaves a solid (ior below 1) is bent away from its normal.
double cosine_in_air(const Glass& glass, double cosine) {
  if (glass.ior >= 1.0 || glass.ior == 0.0)
    return cosine;
  const double sine2 = (1.0 - cosine * cosine) / (glass.ior * glass.ior);
  return std::sqrt(std::max(0.0, 1.0 - sine2));
}

/// F, of light from either side.
Rgb face_reflectance(const Glass& glass, double cosine) {
  const Rgb base = base_reflectance(glass, cosine);
  if (glass.film.share == 0.0 || glass.f90 == 0.0)
    return base;
  return below_film(glass.film, base,
                    glass.f90 * film_reflectance(glass.film, glass.f0 / glass.f90,
                                                 cosine_in_air(glass, cosine)));
}

} // namespace

double fresnel(double ratio, double cosine) {
  if (ratio <= 0.0)
    return 1.0;
  if (ratio == 1.0)
    return 0.0;
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double sine2 = (1.0 - c * c) / (ratio * ratio); // of the angle behind the face
  if (sine2 >= 1.0)
    return 1.0;
  const double behind = std::sqrt(1.0 - sine2);
  const double s = (c - ratio * behind) / (c + ratio * behind);
  const double p = (ratio * c - behind) / (ratio * c + behind);
  return 0.5 * (s * s + p * p);
}

GlassShares glass_shares(const Glass& glass, double cosine) {
  if (glass.faces == GlassFaces::none)
    return {Rgb(0.0), Rgb(1.0)};
  const Rgb f = face_reflectance(glass, cosine);
  if (glass.faces == GlassFaces::one)
    return fresnel(glass.ior, cosine) < 1.0 ? GlassShares{f, glass.tint * (1.0 - f)}
                                            : GlassShares{Rgb(1.0), Rgb(0.0)};
  GlassShares shares;
  for (int band = 0; band < 3; ++band) {
    const double t = glass.tint[band], loop = f[band] * t;
    shares.passed[band] =
        loop < 1.0 ? (1.0 - f[band]) * (1.0 - f[band]) * t / (1.0 - loop * loop) : 0.0;
    shares.reflected[band] = f[band] + loop * shares.passed[band];
  }
  return shares;
}

GlassShares mean_glass_shares(const Glass& glass) {
  // Midpoints in the square of the cosine, of which the weight is even.
  constexpr int count = 256;
  GlassShares mean;
  for (int k = 0; k < count; ++k) {
    const GlassShares at = glass_shares(glass, std::sqrt((k + 0.5) / count));
    mean.reflected += at.reflected / double(count);
    mean.passed += at.passed / double(count);
  }
  return mean;
}

Rgb attenuation(const Material& material, double metres) {
  if (!std::isfinite(material.attenuation_distance))
    return Rgb(1.0);
  return glm::pow(material.attenuation_color, Rgb(metres / material.attenuation_distance));
}

} // namespace meninas
