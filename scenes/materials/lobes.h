// Parts and shares of the bidirectional functions (bsdf.h), as the two passes need them:
// pass one scatters evenly what a material reflects in the mean,
// pass two follows the lobe that has a direction and takes the rest from the field.
#pragma once

#include "scenes/materials/bsdf_parameters.h"
#include "scenes/materials/microfacets.h"
#include "scenes/sampling.h"

#include <algorithm>

namespace meninas {

/// Whether light leaves it otherwise than evenly or by a mirror of constant reflectance:
/// by a lobe, be it a mirror's whose reflectance is a picture or that of a film, or through it.
bool has_lobes(const Material& material);

/// A dielectric whose coat shows, by its factors or, where there is one,
/// at some texel of its textures of roughness and metalness or of transmission.
bool has_visible_coat(const Material& material);

inline Facets facets_of(const Bsdf& bsdf) {
  return {bsdf.alpha * bsdf.stretch, bsdf.alpha, bsdf.axis};
}

/// The directional albedo of its reflection lobe, of the coat's Fresnel term (microfacets.h).
SchlickAlbedo lobe_albedo(const Bsdf& bsdf, const Direction& w);

/// S of a facet that is met at this cosine.
Rgb facet_reflectance(const Bsdf& bsdf, double cosine);

/// The factor in place of S in transmission; glass alone has one.
Rgb facet_transmittance(const Bsdf& bsdf, double cosine);

/// The reflection lobe alone, S D G2 / (4 cos_o cos_i), of directions above the surface;
/// 0 where it is ideal.
Rgb reflection_lobe(const Bsdf& bsdf, const Direction& out, const Direction& in);

/// The parts of f(o, i), ideal lobes left out, in the lobe that has a direction of its own:
/// of metal and coat, and of glass. The rest is even.
struct LobeShares {
  Rgb gloss{0.0}, glass{0.0};
};
LobeShares lobe_shares(const Bsdf& bsdf, const Direction& out, const Direction& in);

/// The lobes without a direction of their own, diffuse and what facets of metal spread:
/// the share that they reflect towards `out` of light that comes evenly from everywhere.
Rgb even_reflectance(const Bsdf& bsdf, const Direction& out);

/// The transmittance of a translucent surface towards `out` for light that comes evenly to its other side.
Rgb even_transmittance(const Bsdf& bsdf, const Direction& out);

/// The rho_s with which the reflection lobe alone reflects, towards `out`,
/// what metal reflects in all: for surfaces without light to be spread.
Rgb metal_all_in_lobe(const Bsdf& bsdf, const Direction& out);

/// The share of light from everywhere that is reflected to anywhere,
/// by all lobes together but those of glass.
Rgb mean_reflectance(const Bsdf& bsdf);

/// diffuse_reflectance() (material.h) of a point.
Rgb diffuse_reflectance(const Material& material, const MaterialPoint& point);

/// tau_d of a point in pass one: what a translucent surface passes evenly of light from everywhere.
Rgb diffuse_transmittance(const Material& material, const MaterialPoint& point);

/// Glass as pass one takes it: it does not scatter what it reflects and passes, however rough.
/// Other parts of the surface are left out, except ideal reflection by metal.
Bsdf clear_glass(const Material& material, const MaterialPoint& point);

/// The coat of a diffuse surface as pass one takes it where it is a mirror:
/// alone, and ideal however rough.
Bsdf mirror_coat(const Material& material);

/// Light scattered below a coat leaves it by (1 - R(cos)) / (1 - R_mean), 1 in the mean:
/// together with the coat's reflection, a white surface is as bright as its surroundings, from everywhere.
Rgb coat_transmittance(const Bsdf& coat, double cosine);

/// The mean shares of light from everywhere that clear glass, or a coat, reflects and passes.
GlassShares mean_shares(const Bsdf& clear);

// --- The frame of a surface, +z along its normal

inline Direction to_local(const Direction& normal, const Direction& w) {
  const TangentFrame frame = tangent_frame(normal);
  return {glm::dot(frame.tangent, w), glm::dot(frame.bitangent, w), glm::dot(normal, w)};
}

inline Direction to_world(const Direction& normal, const Direction& w) {
  const TangentFrame frame = tangent_frame(normal);
  return glm::normalize(w.x * frame.tangent + w.y * frame.bitangent + w.z * normal);
}

/// Towards where a ray of this unit direction has come from;
/// rounding must not take a grazing ray below the surface.
inline Direction local_out(const Direction& normal, const Vec3& ray) {
  const Direction out = to_local(normal, -ray);
  return glm::normalize(Vec3(out.x, out.y, std::max(1e-9, out.z)));
}

} // namespace meninas
