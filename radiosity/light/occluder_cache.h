// The part of an emitter's image that a point sees past its cached occluders B_k, exactly:
//
//   F(x, T_w e - cone(x, B_1) - ... - cone(x, B_n)),   cone(x, B) = {x + s (b - x): b in B, s >= 1}
//
// F is the form factor from the point (dimensionless).
// Shadow rays find the blockers: each is the patch that a ray was blocked by,
// where it stands on that leg of the path in unfolded space, between the leg's mirrors.
// Cones take their shadows out (visible_parts.h), so that a penumbra of a few
// plane edges has no noise; further rays find what else is in the way.
// Patches with holes, and faces that touch an end of a ray, are not taken for blockers.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/light/virtual_light_visibility.h"

#include <optional>
#include <vector>

namespace meninas {

struct CachedOccluder {
  PatchId patch = none<PatchId>;
  std::uint32_t leg = 0;
  Plane plane;           ///< the patch's, in unfolded space
  ConvexPolygon polygon; ///< of unfolded space, cut off where the leg begins and ends
};

/// The occluder that blocked a ray to the emitter's image in a world; none if the shape of its patch does not say
/// what it hides.
std::optional<CachedOccluder> blocker_of(const LightScene& light, WorldId world,
                                       const Emitter& emitter, const LegBlocker& blocker);

/// Subtracts the part that the blocker hides from x from the visible parts of an image.
/// A blocker in whose plane x lies, within `tolerance`, hides nothing.
void subtract(std::vector<ConvexPolygon>& parts, const Point3& x, const CachedOccluder& blocker,
              double tolerance);

} // namespace meninas
