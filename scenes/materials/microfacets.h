// Rough reflection: GGX microfacets (Trowbridge and Reitz 1975, Walter et al.
// 2007) about +z, of width alpha > 0, or of two widths, along an axis of the plane and across it.
#pragma once

#include "scenes/types.h"

namespace meninas {

/// D(h), the density of facet normals: its projected integral over the hemisphere is 1.
double facet_density(double alpha, const Direction& h);

/// Smith's Lambda: the share seen of facets from w is 1 / (1 + Lambda(w)), from two directions
/// at once, correlated by height, 1 / (1 + Lambda(o) + Lambda(i)) (Heitz 2014, eq. 72 and 99).
double smith_lambda(double alpha, const Direction& w);

/// A facet normal as `out` sees them:
/// with density D(h) max(0, o.h) / ((1 + Lambda(o)) o.z) (Heitz 2018).
Direction visible_facet(double alpha, const Direction& out, double u, double v);

/// Facets that are wider along an axis than across it: with x along the axis and y across it, they
/// are round ones stretched by alpha_t and alpha_b (Heitz 2014, section 5; Heitz
/// 2018, eq. 1 to 3):
///
///   D(h) = 1 / (pi alpha_t alpha_b (h_x^2 / alpha_t^2 + h_y^2 / alpha_b^2 + h_z^2)^2)
///   Lambda(w) = (sqrt(1 + (alpha_t^2 w_x^2 + alpha_b^2 w_y^2) / w_z^2) - 1) / 2
///
/// Where both widths are equal they are the functions above.
struct Facets {
  double along = 1.0, across = 1.0; ///< alpha_t, alpha_b
  Vec2 axis{1.0, 0.0};              ///< unit, in the local frame
};
double facet_density(const Facets& facets, const Direction& h);
double smith_lambda(const Facets& facets, const Direction& w);
Direction visible_facet(const Facets& facets, const Direction& out, double u, double v);

/// The directional albedo of a lobe with Fresnel term
/// F0 + (F90 - F0)(1 - o.h)^5 is f0 F0 + f90 F90.
struct SchlickAlbedo {
  double f0 = 0.0, f90 = 0.0;
};

/// At the given cosine, for a roughness (alpha = roughness^2): the ideal lobe,
/// up to `ideal_mirror_roughness`, in closed form, others from a table good to 1e-3.
SchlickAlbedo schlick_albedo(double roughness, double cosine);

/// Its mean over the hemisphere, weighted by the cosine: 2 integral of e(c) c dc.
SchlickAlbedo mean_schlick_albedo(double roughness);

/// The same of facets of two widths, which depends on the azimuth of w: at alpha_t = 1, alpha_b =
/// 0.0025 and 3 degrees above the horizon it is 0.91 along the axis and 0.53 across it. From a table
/// by both widths, the cosine and the azimuth, good to 3e-3, there to 0.02.
SchlickAlbedo schlick_albedo(const Facets& facets, const Direction& w);
SchlickAlbedo mean_schlick_albedo(const Facets& facets);

} // namespace meninas
