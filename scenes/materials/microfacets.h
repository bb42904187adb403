// Rough reflection: GGX microfacets (Trowbridge and Reitz 1975, Walter et al.
// 2007) about +z, of width alpha > 0.
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

} // namespace meninas
