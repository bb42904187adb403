// The form factor between two convex polygons that nothing obstructs.
//
//   F_AB = 1/A_A  int_A F(x, B) dA        (F(x, B): point_form_factor.h)
//        = 1/(2 pi A_A)  oint_A oint_B ln r  dr_A . dr_B     (Stokes; Sparrow 1963)
//
// Polygons are planar, convex, counter-clockwise seen from the front;
// what lies behind the other's plane is cut off first.
// Polygons close to each other (touching edges, gaps of 1e-6 sides) take the contour integral:
// the inner integral over an edge in closed form, the outer one adaptively.
// Polygons far apart, where the contour terms cancel, take Gauss points over A.
// Accuracy about 1e-12 of the contour terms:
// relative 1e-9 or better at every distance; the error estimate says what was reached.
#pragma once

#include "mirror/convex_polygon.h"
#include "form_factors/quadrature.h"

namespace meninas {

/// F_AB, dimensionless: the fraction of the diffuse light of A's front that reaches B's front.
Estimate area_form_factor(const ConvexPolygon& a, const ConvexPolygon& b);

} // namespace meninas
