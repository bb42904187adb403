// Bare Embree loops, to compare with: they do what any renderer must (fill a packet of sixteen,
// trace it, look at the result) with an epsilon instead of planes, and know no sides:
// behind a transparent back they see nothing.
#pragma once

#include "scenes/rays/embree_api.h"
#include "scenes/rays/frame_geometry.h"

namespace meninas::bench {

enum class Query { closest, occlusion };

struct BareScene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};
BareScene make_bare_scene(const FrameGeometry& geometry, RTCSceneFlags flags);
void release(const BareScene& bare);

/// How many rays of the packet, which must be full, meet something.
std::uint32_t trace_bare(const BareScene& bare, Query query, Coherence coherence,
                         const RayPacket& packet);

} // namespace meninas::bench
