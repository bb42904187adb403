// A punctual light as mirrors show it (light_images.h).
#pragma once

#include "scenes/camera.h"
#include "scenes/surfaces/surfaces.h"

#include <vector>

namespace meninas::reference {

struct LightImage {
  PunctualLight light;         ///< reflected: as it is seen straight
  std::vector<PlaneId> planes; ///< in the order in which a path from the point meets them
  std::vector<Bounds> extents; ///< of what may mirror in each
};

} // namespace meninas::reference
