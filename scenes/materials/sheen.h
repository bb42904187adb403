// Cloth's sheen (KHR_materials_sheen): fibres above a surface, which shine where they are seen along
// it.
//
// Their facets stand up: D(h) = (2 + 1/a) sin(theta_h)^(1/a) / (2 pi), a = roughness^2, with the
// shadowing that Conty and Kulla 2017 ("Production Friendly Microfacet Sheen BRDF") have fitted,
//
//   f = c D(h) / (4 cos_o cos_i (1 + Lambda(o) + Lambda(i))).
//
// That lobe is nearly as wide as the hemisphere, so only its albedo counts:
// E(o) = integral of f cos_i / c. A reciprocal lobe with this albedo takes its place:
//
//   f = c E(o) E(i) / (pi E_avg),     E_avg = 2 integral of E(w) w dw.
//
// The layer below has the rest: (1 - m E(o)) (1 - m E(i)) / (1 - m E_avg) of it if it is diffuse, m the
// largest channel of c, so that white fibres on white cloth reflect exactly 1; lobes have the smaller
// of 1 - m E(o) and 1 - m E(i), as glTF says, and ideal mirrors of pass one 1 - m E_avg.
#pragma once

#include "scenes/materials/bsdf_parameters.h"

#include <string>

namespace meninas {

/// E of white fibres, dimensionless; from a table good to 5e-3 of 1.
double sheen_albedo(double roughness, double cosine);
double mean_sheen_albedo(double roughness);

/// 1 - m E(w): what of the light of a direction gets below the fibres; 1 where there are none.
double below_sheen(const Bsdf& bsdf, double cosine);
double mean_below_sheen(const Bsdf& bsdf);

/// The same of a lobe.
double lobe_below_sheen(const Bsdf& bsdf, double cos_out, double cos_in);

/// The fibres' own f, above.
Rgb sheen_lobe(const Bsdf& bsdf, double cos_out, double cos_in);

/// Leaves out textures of sheen that have become no factors. Returns the warning for the user; empty
/// where there are none.
std::string settle_sheen(Material& material);

} // namespace meninas
