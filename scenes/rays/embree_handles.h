// Embree's handles behind a RayScene. Only this folder sees them.
#pragma once

#include "scenes/rays/embree_api.h"
#include "scenes/rays/frame_geometry.h"
#include "scenes/rays/near_planes.h"

namespace meninas {

/// Surfaces nearer to an origin than this times its grain touch it.
inline constexpr double contact_reach = 2e-6;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

struct EmbreeHandles {
  Owned<RTCDevice> device;
  Owned<RTCScene> scene;
  FrameGeometry geometry;
  NearPlanes near_planes;
  float noise = 0.0F; ///< of the geometry, and the lift
  PacketWidth width = PacketWidth::sixteen;

  TracedScene traced() const { return {scene.get(), width}; }
};

} // namespace meninas
