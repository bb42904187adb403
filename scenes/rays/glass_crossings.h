// Glass on a straight way: light passes it, but not all of it.
#pragma once

#include "scenes/rays/ray_scene.h"

#include <optional>
#include <vector>

namespace meninas {

struct GlassCrossing {
  TriangleId triangle = none<TriangleId>;
  Vec2 barycentric{0.0};
  double cosine = 1.0; ///< of the angle to its normal
};

/// The glass between the ends of a leg, in order;
/// not that in whose planes it begins or ends. Clears and fills `crossings`.
void glass_crossings(const RayScene& rays, const Leg& leg, std::vector<GlassCrossing>& crossings);

/// The glass in whose plane a leg ends; none where it ends beside it.
std::optional<GlassCrossing> glass_at_end(const RayScene& rays, const Leg& leg, PlaneId plane);

} // namespace meninas
