// The emission that rays find by chance, as a density estimate over the vertices.
//
// A vertex traces N rays. Where a lamp is seen by a deep chain of mirrors, or in the facets of
// a curved one, no closed form owns its emission (transport/gathered_emission.h), and one ray in
// some thousands meets it: one vertex has k of these hits, others have none, and what is right on
// average is a white dot. As with photons (Jensen 1996) the light of a few hits is spread
// over as large a neighbourhood as holds n of them,
//
//   G'_v = sum_u G_u A_u w_uv / sum_v A_v w_uv,     w_uv = 1 - ring of v around u / (R + 1),
//
// u over vertices with 0 < k < n hits, A the area around a vertex, R the number of rings. The sum
// of A G stays as it is. Relative noise is about 1 / sqrt(2 n / 3), of cones, and more beside edges. Vertices of n hits
// and more are left alone and give way to nothing: light that rays find well keeps its edges.
// Limit: hits rarer than one in a neighbourhood of `max_rings` stay as faint spots of that size.
#pragma once

#include "radiosity/field/vertex_samples.h"

namespace meninas {

/// The emission that a vertex has gathered.
struct VertexEmission {
  std::uint32_t vertex = 0;                      ///< ElementVertexId
  std::uint32_t hits = 0;                        ///< rays that met it
  glm::vec3 total{0.0F}, mirrored{0.0F}; ///< W/m^2
};

/// Spreads it among vertices that have gathered: `taken` by ElementVertexId.
/// `gathered` in the order of the vertices, of those with hits alone: few vertices cost little in a large mesh.
void spread_emission(std::span<const VertexEmission> gathered, std::span<const std::uint8_t> taken,
                     VertexSamples& found);

} // namespace meninas
