// Facets: how curved surfaces come,
// as patches smaller than half an element that continue one another at small angles.
//
// A vertex where at least three facets meet takes the mean of their elements,
// weighted by area (Cohen and Greenberg 1985): light is smooth over the curve,
// noise of single facets averages out, and what would be three gatherings for every facet is none.
// Vertices of one surface are gathered for, as those are whose facets end at an edge,
// but for small ones (scene/small_elements.h), which take the mean of their own elements.
#pragma once

#include "radiosity/field/vertex_places.h"

namespace meninas {

/// Facets whose normals are further apart, degrees, meet at an edge, unless the file gives normals
/// at their corners: then these tell (curved_vertices.h).
inline constexpr double max_facet_turn = 40.0;

/// By ElementVertexId: the facets a vertex takes the mean of; none where it has a value of its own.
VertexElements facets_around(const LightScene& light);

inline bool is_averaged(const VertexElements& facets, std::size_t vertex) {
  return !facets.elements.empty() && !around(facets, vertex).empty();
}

/// By SideId, 1 for facets that turn by more than so many degrees
/// from another one with which a vertex of theirs takes the mean.
std::vector<std::uint8_t> sides_above_crease_angle(const ElementMesh& mesh, const VertexElements& facets,
                                          double degrees);

/// The facets that any vertex takes the mean of, by ElementId: 1.
std::vector<std::uint8_t> averaged_facets(const ElementMesh& mesh, const VertexElements& facets);

/// The mean over the lit ones of a vertex's facets.
/// `irradiance` by ElementId tells which are lit: those inside other things are not.
glm::vec3 facet_mean(const ElementMesh& mesh, std::span<const ElementId> facets,
                     std::span<const Rgb> irradiance, std::span<const Rgb> values);

} // namespace meninas
