// Secondary emitters: reflected light that is so uneven that gather rays would find it by chance
// (the spot a mirror throws on a floor, the sill below a window). When vertices gather,
// such elements are treated as emitters: closed form times shadow rays, also through mirrors.
//
// An element is bright when its reflected radiosity exceeds `contrast` times
// the median over the lit area. Bright neighbours of like radiosity on one side
// are joined into blocks of root cells of a quad, or into cells of the forest.
//
//   B = sum A_e B_e / A,   A = sum A_e,   noise = B sqrt(A)      over the elements e, the brightest channel; B in W/m^2
//
// At most `most` clusters are kept, in all worlds together, the noisiest first; other elements are gathered by rays.
// The least noisy clusters are also left to the rays while their added squared noise stays below `spared`
// times that of the gathered elements, sum A B^2.
// No path is in both: `owned` says which elements are sampled as lamps.
// An element that is cut out in part shines with its solid share from all of it.
#pragma once

#include "radiosity/scene/light_scene.h"

#include <vector>

namespace meninas {

struct ClusterSettings {
  double contrast = 3.0;
  double evenness = 1.5;   ///< largest over smallest radiosity within a cluster, at most
  std::size_t most = 1024; ///< clusters times worlds they are looked at in
  double spared = 0.0;     ///< what the noise that is left to rays may grow by, squared, relative
};

struct SecondaryEmitters {
  std::vector<Emitter> emitters;
  std::vector<std::vector<std::uint32_t>> elements; ///< of each, indices of ElementId
  std::vector<std::uint8_t> owned; ///< by ElementId: its reflected light is a cluster's
  WorldTree worlds; ///< the first worlds of the tree, in which clusters are looked at
};

/// `reflected` by ElementId, W/m^2.
SecondaryEmitters find_secondary_emitters(const LightScene& light, const std::vector<Rgb>& reflected,
                                    const ClusterSettings& settings = {});

} // namespace meninas
