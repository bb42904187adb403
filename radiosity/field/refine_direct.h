// A field that is found, made finer where light from the source bends:
// at the edges of shadows, and of what mirrors throw.
//
// Elements in which D bends by more than X of the scene's mean (interpolation_error.h) are divided,
// up to three times. Surfaces of one element are where D differs between corners, as far as a bend
// may hide in it: once they are divided they have bends of their own. Facets take the means of many
// but where edges are to be seen on them (facet_edges.h).
// At the vertices that elements get light from the source is found.
// The rest is smooth there, or vertices would have asked for more of it:
// it stays what it was between the corners of the elements that were divided.
// So an edge costs shadow rays at few vertices and nothing is gathered.
// Vertices that turn out to be covered, and dark ones as low under what covers a corner of their
// element, keep all that was between the corners: light that is continued to where things stand.
// There are at the most as many more as were solved, or 16,384: where more bend, the most bent.
#pragma once

#include "radiosity/field/interpolation_error.h"
#include "radiosity/field/vertex_gathering.h"

#include <algorithm>

namespace meninas {

/// How many more elements there may be, besides those that follow their neighbours.
inline std::size_t max_at_shadows(std::size_t solved) {
  return std::max<std::size_t>(solved, 16384);
}

/// `result` has the field of what was found, complete_field,
/// and takes the finer mesh and its field where anything bends. X = 0: nothing does.
void refine_direct(const LightScene& light, const VertexSource& source, const BendScale& scale,
                       double x, VertexSamples found, InterpolatedField& result);

} // namespace meninas
