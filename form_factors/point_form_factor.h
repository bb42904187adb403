// The form factor from a point to a polygon, in closed form (Lambert 1760):
//
//   F = 1/(2 pi) | sum_k Theta_k (n . Gamma_k) |
//
// Theta_k is the angle between the directions to vertices k and k + 1,
// Gamma_k the unit normal of the plane they span. The fraction of the light that leaves
// a diffuse point with normal n and reaches the polygon; dimensionless, in [0, 1].
// The polygon must lie above the horizon of n (clip it first).
// Vertices at the point itself, and edges seen end-on, bring nothing:
// the limit from inside. Relative error about 1e-12 for polygons of 1e-9 sr.
#pragma once

#include "scenes/types.h"

#include <span>

namespace meninas {

double point_form_factor(const Point3& x, const Direction& normal, std::span<const Point3> polygon);

} // namespace meninas
