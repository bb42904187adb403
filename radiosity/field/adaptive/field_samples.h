// The samples that a field is made of, on a mesh that is still growing.
//
// Vertices are sampled once. Those on which something stands, or at whose side it does,
// take what is sampled on their edges before it begins to stand there (contact_vertices.h);
// those under a low cover count where nothing open is around them (vertex_light.h).
#pragma once

#include "radiosity/field/adaptive/field_sampler.h"

#include <map>
#include <span>

namespace meninas {

/// What is known of a vertex.
enum class SampleState : std::uint8_t { unknown, covered, low, at_foot, exposed };

/// What is sampled on an edge beside a contact.
struct ContactSample {
  double place = 0.0; ///< as a share of the edge (contact_vertices.h); 0: there is none
  ArrivingLight light = {};
};
/// By the covered end of the edge, then by the other.
using ContactSamples = std::map<std::pair<std::uint32_t, std::uint32_t>, ContactSample>;

/// By ElementVertexId of one mesh.
struct FieldSamples {
  std::vector<PointSample> samples;
  std::vector<SampleState> known;
  ContactSamples contacts;
};
FieldSamples no_samples(const ElementMesh& mesh);

/// Samples the vertices that have no sample, but for those that hang,
/// and the edges between exposed vertices and others that have none.
void sample_field(const LightScene& light, const FieldSampler& sampler, const ElementMesh& mesh,
                  FieldSamples& samples);

/// The samples as a field: covered vertices follow what is beside them,
/// or take their neighbours' values, hanging ones those of their ends.
SampledField field_of(const ElementMesh& mesh, const FieldSamples& samples);

/// Whether samples under a low cover count in an element: none of its corners is exposed.
bool is_low(const ElementMesh& mesh, const FieldSamples& samples, ElementId element);

/// The samples of a mesh for one that was divided from it.
FieldSamples carried(const ElementMesh& before, const FieldSamples& samples,
                     const ElementMesh& after);

/// Depends on the place and not on the numbers of a mesh that is still growing.
std::uint32_t seed_of(SideId side, Vec2 uv);

} // namespace meninas
