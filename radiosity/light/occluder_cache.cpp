#include "radiosity/light/occluder_cache.h"

#include "mirror/reflection.h"
#include "form_factors/visible_parts.h"
#include "scenes/rays/frame_geometry.h"

#include <cmath>

namespace meninas {

namespace {

/// The ancestor of a world, or itself, that many mirrors deep.
const MirrorWorld& at_depth(const WorldTree& tree, WorldId world, std::uint32_t depth) {
  const MirrorWorld* found = &tree.worlds[index(world)];
  while (found->depth > static_cast<int>(depth))
    found = &tree.worlds[index(found->parent)];
  return *found;
}

} // namespace

std::optional<CachedOccluder> blocker_of(const LightScene& light, WorldId world,
                                       const Emitter& emitter, const LegBlocker& blocker) {
  if (blocker.triangle == none<TriangleId>)
    return std::nullopt;
  const auto& facts = light.rays.geometry().facts[index(blocker.triangle)];
  const PatchId id = light.surfaces.patch_of_triangle[index(blocker.triangle)];
  if (facts.cut_out || id == none<PatchId>)
    return std::nullopt;

  // Where it stands on the leg: as the mirrors before it show it.
  const Patch& patch = light.surfaces.patches[index(id)];
  const MirrorWorld& on_leg = at_depth(light.worlds, world, blocker.leg);
  CachedOccluder known{.patch = id, .leg = blocker.leg, .plane = {}, .polygon = {}};
  known.plane = apply(on_leg.image, light.surfaces.surfaces[index(patch.surface)].plane);
  for (const Point3& corner : polygon_of(patch))
    known.polygon.push_back(apply(on_leg.image, corner));

  // The leg runs from the plane of its first mirror to that of the next one, or to the emitter.
  if (on_leg.depth > 0)
    clip_in_place(known.polygon, origin_of(on_leg.plane), -on_leg.plane.normal);
  const MirrorWorld& of_image = light.worlds.worlds[index(world)];
  const Plane end = on_leg.depth == of_image.depth
                        ? apply(of_image.image, emitter.plane)
                        : at_depth(light.worlds, world, blocker.leg + 1).plane;
  clip_in_place(known.polygon, origin_of(end), end.normal);
  if (known.polygon.empty())
    return std::nullopt;
  return known;
}

void subtract(std::vector<ConvexPolygon>& parts, const Point3& x, const CachedOccluder& blocker,
              double tolerance) {
  if (std::abs(signed_distance(blocker.plane, x)) > tolerance)
    subtract_cone(parts, x, blocker.polygon);
}

} // namespace meninas
