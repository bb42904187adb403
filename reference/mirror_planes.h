// The planes of mirrors in which light is reflected (mirrored_lights.h).
#pragma once

#include "scenes/materials/bsdf.h"
#include "scenes/materials/texture_lookup.h"
#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas::reference {

inline constexpr std::size_t longest_chain = 2;
inline constexpr std::size_t max_mirror_planes = 16;

struct MirrorPlanes {
  std::vector<PlaneId> planes; ///< sorted
  std::ptrdiff_t metals_left_out = 0; ///< planes of metal mirrors that are not among them
};

/// The planes on which some metal, be it by texels alone, some pane,
/// or some coat that pass one takes for a mirror mirrors ideally; where they are too many,
/// without coats, then without panes, then without what texels make of metals, then none.
MirrorPlanes find_mirror_planes(const Scene& scene, const SurfaceModel& surfaces,
                                const std::vector<Bsdf>& bsdfs, const DecodedTextures& textures);

Point3 reflected_in(const Plane& plane, const Point3& x);

} // namespace meninas::reference
