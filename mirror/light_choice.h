// The emitter images worth computing at one point, where there are many.
//
// The irradiance that n images bring to x is  H = sum_k h_k. When n exceeds a budget of K, image k takes part with
// probability q_k and counts 1/q_k times:
//
//   H ~ sum_chosen h_k / q_k,    q_k = min(1, K s_k / S),   s_k an estimate of h_k, S their sum,
//
// which is right on average whatever the estimates are, so that no light is counted
// twice or left out. Bright images have q = 1 and are computed without error;
// the rest is sampled at even steps along the tree of emitters (systematic sampling:
// Madow 1949), in all mirror worlds together. The estimates come from a cut through the tree,
// refined where most of the light is: the cost is O(K log n).
//
// Where irradiance is asked for, a node that is small for its distance d, above x's horizon
// and within the window of its world is not opened: its emitters bring together
//
//   H = tau I(omega) cos / d^2     (emitters.h),
//
// off by up to the square of radius over distance, and without the noise of a choice
// (lightcuts: Walter et al. 2005). For shadow rays some of its emitters stand for it,
// chosen by power times cosine.
//
// A second choice at the same point reuses the cut. Points of one small area share the cut of the first,
// refined for the whole area; each evaluates only its nodes.
#pragma once

#include "mirror/light_estimates.h"

namespace meninas {

struct LightChoice {
  std::size_t most = 256; ///< K; as many or fewer images are all computed
  double offset = 0.5;    ///< in [0, 1): of the even steps
  std::size_t afar = 0; ///< above 0: nodes are seen from afar, by so many of their emitters where they bring all of the light
  std::uint64_t area = 0; ///< above 0: a name of the area whose point x is
  double extent = 0.0;    ///< largest distance of two points of it
  bool same_point = false; ///< as the choice before, by the same workspace: only the steps begin elsewhere
};

/// Storage reused from point to point.
struct LightChoiceWorkspace {
  SeenWorlds seen;
  WindowCones cones;
  std::vector<LampView> views; ///< of the worlds in `seen`
  struct CutNode {
    double estimate;     ///< s of the emitters below, brightest channel
    std::uint32_t world; ///< index into `seen`
    std::uint32_t node;
  };
  std::vector<CutNode> open, cut, afar; ///< the last two by place, kept for the same point
  std::vector<CutNode> chosen_from;     ///< of the cut, what steps have not met yet

  /// The nodes of a cut by world, in order, for all points of an area.
  struct AreaNode {
    WorldId world;
    std::uint32_t node;
    bool small; ///< for its distance
  };
  std::uint64_t area = 0; ///< whose cut is kept; to be set to 0 where other points begin
  std::vector<AreaNode> of_area;
  std::vector<WorldId> worlds_of_area; ///< that its first point sees, in ascending order
};

/// Emitters with the tree over them, and the worlds in which they are seen.
struct EmitterChoice {
  const WorldTree& worlds;
  std::span<const Emitter> emitters;
  const LightTree& tree;
};

/// Like virtual_lights(), with at most about `choice.most` emitters' images,
/// each with its weight 1/q, and besides those that stand for nodes seen from afar.
void sample_light_tree(const EmitterChoice& of, const Observer& observer, const LightChoice& choice,
                       LightChoiceWorkspace& work, std::vector<VirtualLight>& lights);

} // namespace meninas
