// Shading normals: a curved surface, given as flat triangles, reflects as the curve would.
//
//   n(b) = (b_0 n_0 + b_1 n_1 + b_2 n_2) / |...|        (Phong 1975)
//
// with n_k the normals at the corners of the triangle (glTF's NORMAL) and b the barycentric
// weights. All normals are of unit length, towards the front.
//
// A normal that points behind its face says nothing there: the face's own stands for it. Where all
// three do, the triangle was wound the other way, and they are turned round.
//
// A direction o above the face may be below the plane of n, or be reflected below the face:
//
//   r = 2 (n.o) n - o,   n_g.r < 0
//
// Then r is lifted to just above the face, and n' is halfway between o and the lifted r
// (Keller et al. 2017, The Iray Light Transport Simulation and Rendering System, 3.1).
//
// Light on a curved surface is looked for from a point on the curve, not on its chord, or facets
// would shade one another where light grazes them. With h_k the height of the point p over the
// tangent plane at corner k (Hanika 2021, Hacking the Shadow Terminator, Ray Tracing Gems II, 4):
//
//   p' = p - sum_k b_k min(0, h_k) n_k,   h_k = n_k . (p - p_k)
//
// A hollow surface is above the tangent planes, and p' is p.
#pragma once

#include "scenes/scene.h"

#include <array>

namespace meninas {

/// A corner's normal, if it is farther from that of the face by more than so many radians,
/// makes the triangle curved. The rounding of exporters is below it.
inline constexpr double min_curve = 1e-3;

/// Tells whether a triangle is curved, by its vertices' normals, which are known up to so many
/// radians.
void mark_curved(Scene& scene, TriangleId triangle, double error = 0.0);

/// n_k as they are used; the face's own where the triangle is not curved.
std::array<Direction, 3> corner_normals(const Scene& scene, TriangleId triangle);

/// n(b); `barycentric` are the weights of the second and the third corner.
Direction shading_normal(const Scene& scene, TriangleId triangle, Vec2 barycentric);

/// n', for a direction `out` above the face. Both normals are towards its side.
Direction visible_normal(const Direction& normal, const Direction& face, const Direction& out);

/// p' over the face (`front`) or over its back.
Point3 point_on_curve(const Scene& scene, TriangleId triangle, Vec2 barycentric, bool front);

/// The direction, or where it is on the wrong side of the face its mirror image in it: lobes about
/// a shading normal keep the light that they would lose.
Direction kept_above(const Direction& direction, const Direction& face);

} // namespace meninas
