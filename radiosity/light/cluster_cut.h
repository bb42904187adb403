// The light of secondary emitters at a point, those far away together (Barnes and Hut 1986;
// lightcuts: Walter et al. 2005).
//
// A node of the cluster tree that is small for its distance,
// r <= theta d with r the radius and d the distance of its sphere, stands for its clusters:
//
//   H ~ tau V sum(B A) cos cos' / (pi d^2)        W/m^2, by channel, from the mean point c of what the clusters send in that channel
//
// if all of the sphere lies above the receiver's horizon and, in a mirror world,
// behind the last mirror and within one visible part of its window.
// A node that is all outside brings nothing.
// Others are opened down to clusters, which are computed in closed form (direct_irradiance.h).
//
// Error before shadows. The first-order term of the Taylor series of k(y) = cos cos' / |y - x|^2 around c
// vanishes, because c is the mean. Along the clusters' plane no second derivative of k
// is larger than 4.43 / |y - x|^4 (its maximum over all directions to x and normals there), thus
//
//   |H - node| <= 2.22 / pi  sum(B A) s^2 / (d - r)^4,     s^2 the mean square of |y - c|, weighted by what is sent; s <= 2 r
//
// V is the share that arrives, by channel, of what shadow rays stand for:
// they go to points of the clusters spread by what these send,
// so that clusters of several colours that are seen in part keep their own.
// All nodes at a point share `rays` of them out by what they would bring,
// with one at least for each and no more than DirectSettings::shadow_rays for each of its clusters.
#pragma once

#include "mirror/window_cones.h"
#include "radiosity/light/cluster_tree.h"
#include "radiosity/light/direct_irradiance.h"

namespace meninas {

struct ClusterCut {
  double theta = 0.15; ///< largest radius over distance of a node, below 1; 0: every cluster in closed form
  int rays = 64;       ///< shadow rays of all nodes at a point together
};

/// A node, or its image in a mirror world.
struct LightcutNode {
  std::uint32_t node = 0, plane = 0; ///< of the tree
  WorldId world = real_world;
  Rgb light{0.0}; ///< what it would bring without blockers, W/m^2
};

/// Storage reused from point to point; one for each thread.
struct ClusterWorkspace {
  SeenWorlds seen;
  WindowCones cones;
  std::vector<std::uint32_t> open;      ///< nodes still to be looked at
  std::vector<LightcutNode> stand_ins;
  struct Ray {
    std::uint32_t stand_in, number; ///< number among its own
  };
  std::vector<Ray> rays;
  std::vector<Rgb> sent, arrived; ///< by stand-in: sums over its rays, and over those that arrive
};

/// Finds what lights x: nodes that stand for their clusters in `work.stand_ins`,
/// images of all others in `lights`. Clears both.
void cut_clusters(const Lighting& light, const ClusterTree& tree, const Receiver& receiver,
                  double theta, ClusterWorkspace& work, std::vector<VirtualLight>& lights);

/// The secondary emitters and their tree, the same for all points.
struct ClusterLight {
  const Lighting& light; ///< has the clusters for emitters
  const ClusterTree& tree;
  const DirectSettings& settings;
  const ClusterCut& cut;
};

/// H of the clusters, W/m^2. Adds the shadow rays of both kinds to those of `direct`.
ArrivingLight cluster_irradiance(const ClusterLight& clusters, const Receiver& receiver,
                                 std::uint32_t seed, ClusterWorkspace& work,
                                 DirectWorkspace& direct);

} // namespace meninas
