// The point, line or plane that several planes have in common.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <span>

namespace meninas {

/// The shortest way from x into all of the planes: d of least length that minimises
/// sum (n_k . (x + d) - o_k)^2, by the pseudo-inverse. Planes whose normals differ by less than
/// about 0.05 count as one, as to where such planes meet it may be far.
Vec3 way_into(const Point3& x, std::span<const Plane> planes);

} // namespace meninas
