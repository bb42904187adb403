// Refinement of direct light: elements are divided at the edges of shadows and of mirrored light.
//
// An element is divided, up to three times, where the interpolation error of D exceeds X of the
// scene's mean (interpolation_error.h). A surface of a single element has no second difference: it
// is divided once if D at its corners differs enough to hide a parabola beyond the bound, and its
// parts then have second differences. Facets take means of their smoothing group, except where an
// edge shows on them (facet_edges.h).
//
// D is computed at the new vertices. Indirect light is smooth there and is interpolated between the
// corners of the divided elements, so an edge costs shadow rays at few vertices and no gathering.
// A new vertex that is covered, or dark under a low cover, keeps the interpolated value: light is
// continued to where things stand.
//
// For one view only elements are divided whose direct light is looked up in the field (SeenElements::direct),
// and what a path shows by a share of its light may be off by so much more: of an element of weight w the error
// counts w times (importance: Smits, Arvo and Salesin 1992).
//
// At most max(N, 16384) new elements are made; if more exceed the bound, the largest errors come first.
#pragma once

#include "radiosity/field/interpolation_error.h"
#include "radiosity/field/final_gathering.h"

#include <algorithm>
#include <span>

namespace meninas {

/// The largest number of new elements, besides those that follow their neighbours.
inline std::size_t max_at_shadows(std::size_t solved) {
  return std::max<std::size_t>(solved, 16384);
}

/// The criterion by which elements are divided.
struct DirectRefinement {
  BendScale scale;
  double x = 0.0;                          ///< X; 0: none
  std::span<const float> weights = {};     ///< by ElementId of the scene's mesh; empty: all weigh 1
};

/// `result` has the completed field of what was found,
/// and takes the finer mesh and its field where anything bends.
void refine_direct(const LightScene& light, const VertexSource& source,
                   const DirectRefinement& refinement, VertexSamples found,
                   InterpolatedField& result);

} // namespace meninas
