// How much fibres of sheen reflect (sheen.h): E(w), the share of light from a direction, and E_avg, that of
// even light, both dimensionless. Conty and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
#pragma once

namespace meninas {

/// E of white fibres, dimensionless; from a table good to 5e-3 of 1.
double sheen_albedo(double roughness, double cosine);
double mean_sheen_albedo(double roughness);

} // namespace meninas
