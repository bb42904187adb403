// Scenes with the light of pass one, by whichever transport.
#pragma once

#include "tests/radiosity/lit_scene.h"

namespace meninas::test {

struct Solved {
  RadiositySolution solution;
  std::vector<NodeLight> nodes;
};

/// `by_shots`: by rays that are shot and not kept, however few elements there are.
Solved solved(const Scene& scene, const PassOneSettings& settings, bool by_shots = false);

/// The mean irradiances of all nodes of more than a square metre agree to a share of them:
/// smaller ones have but a few elements.
void expect_alike(const Solved& a, const Solved& b, double tolerance);

} // namespace meninas::test
