// The emitters' images that all points of a region see alike, found once instead of at each point.
//
// A segment from x to y passes the edge from a to b of a window on the side that the sign of
//
//   f(x, y) = ((a - x) x (b - x)) . (y - x)
//
// tells. f is affine in x and affine in y: over a convex region and a convex image it lies between
// its values at their corners. So where these agree for all edges of all windows of a chain,
// and so do the heights over the horizon and the planes of emitter and mirrors, the image
// is seen whole from all of the region; where one edge of a window has all of them outside,
// from none of it. Other images are cut point by point, as virtual_lights.h does,
// and so are the windows that this takes: the lights are the same, to the bit.
#pragma once

#include "mirror/virtual_lights.h"

namespace meninas {

/// A convex part of a plane, lit from the side of the normal.
struct ReceivingRegion {
  std::span<const Point3> corners;
  Direction normal;
  double tolerance = 0.0; ///< of points, in and off the region, and of the planes of emitters (Observer)
};

/// A world of which something may be seen, depth first.
struct RegionWorld {
  WorldId world = real_world;
  std::uint32_t parent = 0;         ///< its place among the worlds of the region
  bool whole = true;                ///< its window is seen whole by way of its parent's
  bool opens = false;               ///< what is seen of its window is asked for
  std::uint32_t first = 0, last = 0; ///< of the images
};
struct RegionImage {
  std::uint32_t emitter = 0;
  bool whole = true;
};
struct RegionImages {
  std::vector<RegionWorld> worlds; ///< [0] the real one
  std::vector<RegionImage> images; ///< that any point of the region may see
};

/// Clears and fills `images`. O(worlds (emitters + mirrors) depth).
void images_of_region(const WorldTree& tree, std::span<const Emitter> emitters,
                      const ReceivingRegion& region, RegionImages& images);

/// The lights of all_lights() at a point of the region.
/// Clears and fills `lights`; `seen` is storage.
void lights_in_region(const WorldTree& tree, std::span<const Emitter> emitters,
                      const RegionImages& images, const Observer& observer, SeenWorlds& seen,
                      std::vector<VirtualLight>& lights);

} // namespace meninas
