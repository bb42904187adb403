// The expected seconds of pass one on this machine, measured before it starts.
//
// Stages are counted in what they do most of, and a few of each are done to see how long one takes
// here, in this scene:
//
//   form factors   elements x (one gathering of N rays + some points of direct light)
//   interpolate    vertices x (one gathering + one point of direct light)
//                  A hierarchical mesh gathers for nodes instead, of which there are about
//                  twice those of its beginning, and finds direct light for nodes
//   solve          entries of the transport x products with it, at the rate of memory
//
// So seconds = sum of counts x seconds of one, and solve = 16 products x 2 ns x bands x rows x min(N, elements).
#pragma once

#include "radiosity/pass_one_settings.h"
#include "radiosity/scene/light_scene.h"

namespace meninas {

/// Seconds of one thread; `solve` of all that memory keeps busy.
struct PassOneCost {
  double form_factors = 0.0, solve = 0.0, interpolate = 0.0;
};

/// `bands` as of the plan. Takes a fraction of a second in any scene.
PassOneCost expected_cost(const LightScene& light, int bands, const PassOneSettings& settings);

} // namespace meninas
