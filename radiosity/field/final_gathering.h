// Final gathering (Reichert 1992): once the elements are solved, irradiance is gathered once more, at every vertex.
//
// Light is gathered at vertices one by one (vertex_light.h):
// direct and indirect together, or indirect light only where it is asked for.
// Once all that are to have a value have one, the field is completed:
// what stands on a surface takes what is gathered beside it (contact_vertices.h,
// gap_vertices.h), vertices that hang take from their ends,
// and those that are left from their neighbours (vertex_fill.h).
// All values are irradiance, W/m^2.
#pragma once

#include "radiosity/field/vertex_samples.h"

namespace meninas {

/// Gathers from elements with the radiosity `reflected`, using the fraction `share` of the rays.
/// `spared`: ClusterSettings::spared. Clusters in many planes cost more than 128 rays.
/// `before`: the share whose rays may already be cached (row_cache.h).
PointGathering gathering_from(const LightScene& light, SentLight reflected,
                              const VertexGathering& how, RayShare share = {}, double spared = 0.0,
                              std::optional<RayShare> before = {});

VertexSamples make_samples(ElementMesh mesh);
/// Every lamp is dark at every vertex, where light is told apart.
void make_room_for_lamps(const LightScene& light, VertexSamples& found);
/// The same on the scene's mesh. Vertices of these facets (smoothing_groups.h) are `smoothed`, their values to come.
VertexSamples make_samples(const LightScene& light, const VertexElements& facets);

/// Gathers at the vertices that are unknown and do not hang.
void gather_at_vertices(const VertexSource& source, std::uint32_t level, VertexSamples& found);

/// Direct light only, at the same vertices. Dark vertices beside bright ones are also tested for cover: a
/// covered one takes its neighbours' light, an open one keeps zero, and confusing the two is visible.
/// `level` as above. Vertices that are not seen (VertexSource) take as few images as an element's points do.
void light_vertices(const VertexSource& source, std::uint32_t level, VertexSamples& found);

/// Adds indirect light at vertices that have direct light and are marked, by ElementVertexId.
/// Takes rays that the source has kept of them, and keeps those of others if it keeps more.
void gather_at_lit(const VertexSource& source, std::span<const std::uint8_t> marked,
                   VertexSamples& found);

/// By ElementVertexId: 1 where there is a value.
std::vector<std::uint8_t> with_values(const VertexSamples& found);

/// The field with values at all vertices.
VertexIrradiance complete_field(const VertexSource& source, const VertexSamples& found);

/// Values by ElementVertexId for those that only gather from them:
/// what has none, beside contacts too, is as its neighbours are.
std::vector<glm::vec3> filled(const VertexSamples& found, std::vector<glm::vec3> values);

} // namespace meninas
