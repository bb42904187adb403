// Scattering at a point of a surface: the bidirectional functions behind the material model
// (scenes/material.h).
//
// Four lobes, all about the normal +z of a local frame:
//   diffuse       f = rho_d (1 - e(o)) (1 - e(i)) / (pi (1 - e_avg))
//   passed        the same with tau_d of translucent surfaces in place of rho_d, i below the surface
//   reflection    f = S(o.h) D(h) G2(o, i) / (4 cos_o cos_i),  S = rho_s + coat Fresnel(o.h),  h the half vector
//   transmission  the reflection lobe folded through the surface, with what glass passes in place of S: a thin pane does not bend light
// The surface is a mixture by area: metal, dielectric below its coat, and glass,
// metallic to (1 - metallic) (1 - transmission) to (1 - metallic) transmission.
// D is GGX of width alpha = roughness^2, G2 Smith's height-correlated masking and shadowing (Walter
// et al. 2007, Heitz 2014); of two widths, by the axis of the local frame, where the material is
// anisotropic (microfacets.h). Multiple scattering between facets of metal, which a single-scattering lobe loses,
// is added as a diffuse lobe (Kulla and Conty 2017): a white metal reflects all light, however rough.
// At roughness `ideal_mirror_roughness` and below reflection and transmission are ideal:
// one direction each, of weight S and T, which only sampling can find.
//
// rho_s, the reflectance of metals, is constant (material.h). The Schlick coat
// F0 + (F90 - F0)(1 - o.h)^5 of dielectrics is there up to `visible_coat_roughness`;
// rougher ones count as diffuse. The layer below lacks its albedo, e(w) = integral of its lobe:
// the diffuse lobe is coupled as by Kelemen and Szirmay-Kalos 2001,
// reciprocal, and for rho_d = 1 reflection and diffuse add up to exactly 1.
//
// Glass reflects R and passes T at every roughness (glass.h).
//
// Directions point away from the surface. f is per steradian, without the cosine.
#pragma once

#include "scenes/materials/bsdf_parameters.h"

#include <array>
#include <optional>

namespace meninas {

/// f(o, i), ideal lobes left out; `out` is above the surface, `in` anywhere.
Rgb evaluate(const Bsdf& bsdf, const Direction& out, const Direction& in);

/// The density per steradian with which `sample` finds `in`, ideal lobes left out.
double sample_density(const Bsdf& bsdf, const Direction& out, const Direction& in);

enum class Lobe {
  spread,           ///< a direction with a density
  ideal_reflection, ///< the mirror direction
  straight          ///< ideal transmission: -out
};

struct BsdfSample {
  Direction in{0.0, 0.0, 1.0};
  Rgb weight{
      0.0}; ///< f cos / density; for ideal lobes what they reflect over the chance to choose them
  double density = 0.0; ///< per steradian; 0 for ideal lobes
  Lobe lobe = Lobe::spread;
};

/// A direction from which light may come, `u` evenly in [0, 1)^3;
/// none where the surface absorbs or the lobe dips below it.
std::optional<BsdfSample> sample(const Bsdf& bsdf, const Direction& out,
                                 const std::array<double, 3>& u);

/// The weight of ideal transmission straight through at this cosine; 0 where there is none.
Rgb straight_transmission(const Bsdf& bsdf, double cosine);

/// The weight of ideal reflection at this cosine; 0 where there is none.
Rgb ideal_reflection(const Bsdf& bsdf, double cosine);

/// The albedo of the coat for light from a direction, e(w) above: the largest channel.
double coat_albedo(const Bsdf& bsdf, const Direction& w);

} // namespace meninas
