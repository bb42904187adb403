// Shadow rays of the points of a mean (shared_light.h), traced sixteen together with others by way of as many mirrors.
//
// A ray that arrives adds its weight g and what is left of its light; one that is blocked teaches the image its
// occluder, if it learns any (occluder_cache.h). Rays to the rim of an image have the weight 0: they only teach.
// Positions in metres, weights dimensionless.
#pragma once

#include "radiosity/light/image_sums.h"
#include "radiosity/light/light_samples.h"

#include <vector>

namespace meninas {

/// A shadow ray that waits for others by way of about as many mirrors.
struct WaitingRay {
  WorldId world = real_world;
  int mirrors = 0;
  std::uint32_t image = 0; ///< index of its ImageSum
  PlaneId arriving = none<PlaneId>;
  double weight = 0.0;
  Point3 from, to;
};

struct WaitingRays {
  std::vector<WaitingRay> rays;
  std::vector<std::uint32_t> order, first_with; ///< of these, by their mirrors
};

/// Traces the rays that wait, which come from points of one surface, as the receiver is, and adds what they find to
/// the sums of their images; none waits any longer.
void trace_waiting(const Lighting& light, const Receiver& receiver, WaitingRays& waiting,
                   std::vector<ImageSum>& images, DirectWorkspace& work);

} // namespace meninas
