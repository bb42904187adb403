// What a point sees of an emitter's image past
// the blockers that are known to be in the way, exactly:
//
//   F(x, T_w e without the cones from x over B_1 ... B_n)
//
// Shadow rays find the blockers: each is the patch that a ray was blocked by,
// where it stands on that leg of the path in unfolded space, between the leg's mirrors.
// Cones take their shadows out (visible_parts.h), so that a penumbra of a few
// plane edges has no noise; what else is in the way is for further rays to tell.
// Patches with holes, and what touches an end of a ray, are not taken for blockers.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/light/shadow_paths.h"

#include <optional>
#include <vector>

namespace meninas {

struct CachedOccluder {
  PatchId patch = none<PatchId>;
  std::uint32_t leg = 0;
  Plane plane;           ///< the patch's, in unfolded space
  ConvexPolygon polygon; ///< of unfolded space, cut off where the leg begins and ends
};

/// What blocked a ray to the emitter's image in a world.
/// Nothing where its shape would not tell what it hides.
std::optional<CachedOccluder> blocker_of(const LightScene& light, WorldId world,
                                       const Emitter& emitter, const LegBlocker& blocker);

/// Takes from the visible parts of an image what the blocker hides from x.
/// In whose plane x lies, within `tolerance`, hides nothing.
void subtract(std::vector<ConvexPolygon>& parts, const Point3& x, const CachedOccluder& blocker,
              double tolerance);

} // namespace meninas
