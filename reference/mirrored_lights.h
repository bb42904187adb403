// Light of emitting surfaces by way of plane mirrors, found from the other end:
// next-event estimation through chains of ideal mirrors.
//
// A reflection is an isometry: a path x -> z1 -> ... -> zL -> y over the planes m1 ...
// mL is the straight line from the image x' of x (reflected in m1, then m2,
// ...) to y, of the same length and with the same angle at y. Choosing y on a light
// and each of the L planes evenly among M finds the direction at x with density
//   p_l(omega) = P(triangle) / area * |x' - y|^2 / |cos at y| / M^L,
// and x -> z1 follows from it; the chain counts if it meets exactly those planes. The same path
// is met by chance with density p_s: both are weighted as for direct light (trace_paths.h),
// so the estimate stays unbiased. Punctual lights are looked for in light_images.h.
// Chains are at most `longest_chain` long; light over longer ones,
// or in scenes with more than `max_mirror_planes` of them (curved mirrors), is only met.
#pragma once

#include "reference/mirror_planes.h"
#include "reference/traced_scene.h"

#include <optional>

namespace meninas::reference {

/// Planes in the order in which a path from a point meets them, and the point's image x'.
struct Chain {
  std::vector<PlaneId> planes;
  Point3 image;
};
/// None where the same plane would follow itself.
std::optional<Chain> choose_chain(const TracedScene& traced, const Point3& x, std::size_t length,
                                  double u);

/// The image of y that x sees: where the path sets out to.
Point3 first_target(const TracedScene& traced, const Chain& chain, Point3 y);

/// The share of light from y that reaches x over the chain, past mirrors, panes and holes;
/// 0 where the path is blocked or misses a mirror.
Rgb chain_throughput(const TracedScene& traced, const SurfacePoint& x, const Chain& chain,
                     const Point3& y, PlaneId arriving);

} // namespace meninas::reference
