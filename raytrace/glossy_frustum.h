// The reflection frustum of a glossy surface (Wallace, Cohen, Greenberg 1987):
// the solid angle of its lobe, divided into n x n directions with weights.
//
//   L(o) = sum_k w_k L(i_k),   w_k = S(o.h_k) g_k / norm,   g_k = G2(o, i_k) / G1(o),   i_k = o reflected at the facet normal h_k
//
// Cell k of the unit square is mapped to the facets that o sees (Heitz 2018), so that every
// cell holds as much of the lobe: what is left of f cos / density is S g (scenes/materials/bsdf.h).
// Cells are met at one shifted point each; the shift differs from ray to ray.
// The norm makes the weights add up to the lobe's albedo whatever n:
// under even light a white metal and what its facets spread add up to exactly 1.
// So the sum converges to the convolution of the light with the lobe,
// with an error of order 1 / n^2 in the mean (it is a ratio of sums).
//
// Behind another lobe one direction at random stands for the grid.
// It keeps its own weight S g, whose mean is right: the norm would make every
// single one the whole albedo, however little the facets let through towards it.
//
// A pane has the same lobe once more,
// folded through the surface, with what it passes in place of S.
//
// Facets of two widths have the same map, stretched along their axis: cells follow the lobe.
//
// A lobe of no width (roughness at most `ideal_mirror_roughness`) is one direction, the mirror's.
#pragma once

#include "scenes/materials/lobes.h"

#include <vector>

namespace meninas {

/// A direction of the local frame from which light comes, and how much of it goes on towards `out`.
struct LobeRay {
  Direction in{0.0, 0.0, 1.0};
  Rgb weight{0.0};
  bool through = false; ///< the pane, whether straight or scattered
};

/// The density per steradian of the facets' map: n^2 of it is that of the grid's directions.
double lobe_density(const Bsdf& bsdf, const Direction& out, const Direction& in);

/// n for about `directions` in the widest and brightest lobe.
/// Smoother ones are narrower, faint ones matter less.
int lobe_divisions(const Bsdf& bsdf, const Direction& out, double directions);

/// The directions of light that leaves towards `out`, which is above the surface;
/// `shift` in [0, 1)^2. Clears and fills `rays`.
void glossy_frustum(const Bsdf& bsdf, const Direction& out, int divisions, Vec2 shift,
               std::vector<LobeRay>& rays);

/// One direction in place of the grid, or none where its facet reflects below the surface.
void lobe_sample(const Bsdf& bsdf, const Direction& out, Vec2 u, std::vector<LobeRay>& rays);

} // namespace meninas
