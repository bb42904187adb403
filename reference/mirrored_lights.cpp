#include "reference/mirrored_lights.h"

#include "scenes/materials/normal_map.h"

#include <algorithm>
#include <cmath>

namespace meninas::reference {

std::optional<Chain> choose_chain(const TracedScene& traced, const Point3& x, std::size_t length,
                                  double u) {
  const auto& planes = traced.mirror_planes;
  Chain chain{{}, x};
  for (std::size_t k = 0; k < length; ++k) {
    // One number makes all choices: its whole part this one, the rest the others.
    const double scaled = u * double(planes.size());
    const auto choice = std::min(static_cast<std::size_t>(scaled), planes.size() - 1);
    u = scaled - double(choice);
    // No ray meets the plane it leaves.
    if (k > 0 && chain.planes.back() == planes[choice])
      return std::nullopt;
    chain.planes.push_back(planes[choice]);
    chain.image = reflected_in(traced.surfaces.planes[index(planes[choice])], chain.image);
  }
  return chain;
}

Point3 first_target(const TracedScene& traced, const Chain& chain, Point3 y) {
  for (std::size_t k = chain.planes.size(); k-- > 0;)
    y = reflected_in(traced.surfaces.planes[index(chain.planes[k])], y);
  return y;
}

Rgb chain_throughput(const TracedScene& traced, const SurfacePoint& x, const Chain& chain,
                     const Point3& y, PlaneId arriving) {
  constexpr int max_layers = 256;
  // Nothing in the plane of a mirror is seen in it.
  if (!chain.planes.empty() && chain.planes.back() == arriving)
    return Rgb(0.0);
  Rgb throughput(1.0);
  Point3 from = x.origin, target = first_target(traced, chain, y);
  PlaneId leaving = x.leaving;
  std::size_t reflections = 0;
  for (int layer = 0; layer < max_layers && throughput != Rgb(0.0); ++layer) {
    const bool last_leg = reflections == chain.planes.size();
    const double length = glm::length(target - from);
    const Direction direction = (target - from) / length;
    const auto hit = closest_hit(traced.rays, {from, direction, leaving, length});
    if (!hit)
      return last_leg ? throughput : Rgb(0.0);
    const SurfacePoint at = surface_point(traced, hit->triangle, hit->barycentric, hit->front);
    if (last_leg && at.plane == arriving)
      return throughput;
    const double cosine = -glm::dot(at.normal, direction);
    from = at.position;
    leaving = at.plane;
    if (at.hole)
      continue;
    if (at.black)
      return Rgb(0.0);
    // Only paths meet the light that a curved mirror reflects.
    const bool curved = is_bent(traced.scene, hit->triangle);
    if (!last_leg && !curved && at.plane == chain.planes[reflections]) {
      throughput *= ideal_reflection(at.bsdf, cosine);
      target = reflected_in(traced.surfaces.planes[index(at.plane)], target);
      ++reflections;
    } else {
      throughput *= straight_transmission(at.bsdf, cosine);
    }
  }
  return Rgb(0.0);
}

} // namespace meninas::reference
