// The rays of the two ray-bound stages, ready for bare loops:
// the same rays in the same order and packets as the stages trace them,
// a share of all that is large enough to be typical and small enough to stay in the caches.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"
#include "raytrace/render.h"

namespace meninas::bench {

/// Full packets only; what does not fill one is left out.
struct StageRays {
  std::vector<RayPacket> first;     ///< from elements, or from the camera
  std::vector<RayPacket> reflected; ///< that go on behind mirrors
};

/// Sixteen cosine-distributed rays of neighbouring directions from points all over one element.
StageRays gather_rays_of(const LightScene& light, int rays, std::size_t packets);

/// Samples of one pixel, for pixels all over the picture.
StageRays camera_rays_of(const LightScene& light, const Camera& camera,
                         const RenderSettings& settings, std::size_t packets);

} // namespace meninas::bench
