// Of many emitter images, those worth computing at one point.
//
// What n images bring to x is  H = sum_k h_k. When n exceeds a budget of K, image k takes part with probability q_k and counts 1/q_k times:
//
//   H ~ sum_chosen h_k / q_k,    q_k = min(1, K s_k / S),   s_k an estimate of h_k, S their sum,
//
// which is right on average whatever the estimates are, so that no light is counted
// twice or left out. Images that bring much have q = 1 and are computed without error;
// the rest is sampled at even steps along the tree of emitters (systematic sampling:
// Madow 1949), in all mirror worlds together. The estimates come from a cut through the tree,
// refined where most of the light is: the cost is O(K log n).
#pragma once

#include "mirror/virtual_lights.h"

namespace meninas {

struct LightChoice {
  std::size_t most = 256; ///< K; as many or fewer images are all computed
  double offset = 0.5;    ///< in [0, 1): of the even steps
};

/// Storage reused from point to point.
struct LightChoiceWorkspace {
  SeenWorlds seen;
  struct CutNode {
    double estimate;     ///< s of the emitters below, brightest channel
    std::uint32_t world; ///< index into `seen`
    std::uint32_t node;
  };
  std::vector<CutNode> open, cut;
};

/// Emitters with the tree over them, and the worlds in which they are seen.
struct EmitterChoice {
  const WorldTree& worlds;
  std::span<const Emitter> emitters;
  const LightTree& tree;
};

/// Like virtual_lights(), with at most about `choice.most` emitters' images,
/// each with its weight 1/q.
void sample_light_tree(const EmitterChoice& of, const Observer& observer, const LightChoice& choice,
                       LightChoiceWorkspace& work, std::vector<VirtualLight>& lights);

} // namespace meninas
