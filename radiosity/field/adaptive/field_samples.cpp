#include "radiosity/field/adaptive/field_samples.h"

#include "radiosity/field/contact_vertices.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/vertex_fill.h"
#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace meninas {

std::uint32_t seed_of(SideId side, Vec2 uv) {
  return hash(index(side), std::bit_cast<std::uint32_t>(static_cast<float>(uv.x)),
              std::bit_cast<std::uint32_t>(static_cast<float>(uv.y)));
}

FieldSamples no_samples(const ElementMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  return {std::vector<PointSample>(count), std::vector(count, SampleState::unknown), {}};
}

namespace {

std::vector<std::uint8_t> hanging_in(const ElementMesh& mesh) {
  std::vector<std::uint8_t> hanging(mesh.vertices.size(), 0);
  for (const HangingVertex& h : mesh.hanging)
    hanging[index(h.vertex)] = 1;
  return hanging;
}

/// The seed of a place on the side of an element.
std::uint32_t seed_at(const LightScene& light, const ElementMesh& mesh, ElementId element,
                      const Point3& place) {
  const SideId side = mesh.side_of_element[index(element)];
  const Patch& patch = light.surfaces.patches[index(mesh.sides[index(side)].patch)];
  return seed_of(side, uv_at(patch, place));
}

SampleState state_of(const LightScene& light, const Receiver& receiver, const PointSample& sample) {
  switch (sample.cover) {
  case Cover::shut:
    return SampleState::covered;
  case Cover::low:
    return SampleState::low;
  case Cover::open:
    break;
  }
  return touches_wall(light, receiver) ? SampleState::at_foot : SampleState::exposed;
}

void sample_vertices(const LightScene& light, const FieldSampler& sampler, const ElementMesh& mesh,
                     FieldSamples& samples) {
  const std::vector<std::uint8_t> hanging = hanging_in(mesh);
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t v) {
    if (samples.known[v] != SampleState::unknown || hanging[v] != 0)
      return;
    const ElementId element = mesh.element_of_vertex[v];
    samples.samples[v] = sampler.at_vertices(receivers[v], size_of(mesh, element),
                                             seed_at(light, mesh, element, mesh.vertices[v]));
    samples.known[v] = state_of(light, receivers[v], samples.samples[v]);
  });
}

/// On the edge from an exposed vertex to a covered one.
ContactSample sample_contact(const LightScene& light, const FieldSampler& sampler,
                             const ElementMesh& mesh, Receiver point, const ContactEdge& edge) {
  const auto [covered, exposed] = edge;
  const ElementId element = mesh.element_of_vertex[exposed];
  const double size = size_of(mesh, element);
  const Point3& end = mesh.vertices[covered];
  const std::uint32_t seed = hash(seed_at(light, mesh, element, mesh.vertices[exposed]),
                                  seed_at(light, mesh, element, end));
  const double place = contact_place(
      point, end, [&](const Receiver& receiver) { return sampler.is_open(receiver, size, seed); });
  if (place == 0.0)
    return {};
  point.position = glm::mix(point.position, end, place);
  const PointSample sample = sampler.at_vertices(point, size, seed);
  return sample.cover == Cover::open ? ContactSample{place, sample.light} : ContactSample{};
}

void sample_contacts(const LightScene& light, const FieldSampler& sampler, const ElementMesh& mesh,
                     FieldSamples& samples) {
  std::vector<std::uint8_t> exposed;
  for (const SampleState known : samples.known)
    exposed.push_back(known == SampleState::exposed ? 1 : 0);
  const std::vector<ContactEdge> edges = contact_edges(mesh, exposed);
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  std::vector<ContactSample> contacts(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t k) {
    const auto before = samples.contacts.find({edges[k].covered, edges[k].exposed});
    contacts[k] = before != samples.contacts.end()
                      ? before->second
                      : sample_contact(light, sampler, mesh, receivers[edges[k].exposed], edges[k]);
  });
  samples.contacts.clear();
  for (std::size_t k = 0; k < edges.size(); ++k)
    samples.contacts[{edges[k].covered, edges[k].exposed}] = contacts[k];
}

/// By ElementVertexId: 1 where its sample counts.
std::vector<std::uint8_t> with_samples(const ElementMesh& mesh, const FieldSamples& samples) {
  std::vector<std::uint8_t> valid;
  for (const SampleState known : samples.known)
    valid.push_back(known == SampleState::unknown || known == SampleState::covered ? 0 : 1);
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    if (!is_low(mesh, samples, static_cast<ElementId>(e)))
      for (const ElementVertexId v : mesh.corners[e])
        if (samples.known[index(v)] == SampleState::low)
          valid[index(v)] = 0;
  return valid;
}

} // namespace

bool is_low(const ElementMesh& mesh, const FieldSamples& samples, ElementId element) {
  return std::ranges::none_of(mesh.corners[index(element)], [&](ElementVertexId v) {
    const SampleState known = samples.known[index(v)];
    return known == SampleState::exposed || known == SampleState::at_foot;
  });
}

void sample_field(const LightScene& light, const FieldSampler& sampler, const ElementMesh& mesh,
                  FieldSamples& samples) {
  sample_vertices(light, sampler, mesh, samples);
  sample_contacts(light, sampler, mesh, samples);
}

SampledField field_of(const ElementMesh& mesh, const FieldSamples& samples) {
  SampledField field;
  for (const PointSample& sample : samples.samples) {
    field.total.emplace_back(sample.light.total);
    field.mirrored.emplace_back(sample.light.mirrored);
  }
  std::vector<std::uint8_t> valid = with_samples(mesh, samples);
  for (auto* values : {&field.total, &field.mirrored})
    settle_hanging(mesh, *values);
  std::map<std::uint32_t, ContactLines> lines_to;
  for (const auto& [ends, contact] : samples.contacts)
    if (contact.place > 0.0)
      lines_to[ends.first].add({Rgb(field.total[ends.second]), Rgb(field.mirrored[ends.second])},
                               contact.light, contact.place);
  for (const auto& [v, lines] : lines_to) {
    const ArrivingLight light = lines.mean();
    field.total[v] = glm::vec3(light.total);
    field.mirrored[v] = glm::vec3(light.mirrored);
    valid[v] = 1;
  }
  for (auto* values : {&field.total, &field.mirrored}) {
    fill_vertices(mesh, valid, *values);
    settle_hanging(mesh, *values);
  }
  return field;
}

FieldSamples carried(const ElementMesh& before, const FieldSamples& samples,
                     const ElementMesh& after) {
  FieldSamples result = no_samples(after);
  constexpr std::uint32_t nowhere = index(none<ElementVertexId>);
  std::vector<std::uint32_t> vertex_now(before.vertices.size(), nowhere);
  const std::vector<CellId> now = same_cells(before, after);
  for (std::size_t e = 0; e < element_count(before); ++e) {
    const ElementCorners corners = same_corners(before, static_cast<ElementId>(e), after,
                                                now[index(before.cell_of_element[e])]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (corners[c] == none<ElementVertexId>)
        continue;
      const std::uint32_t from = index(before.corners[e][c]), to = index(corners[c]);
      vertex_now[from] = to;
      result.samples[to] = samples.samples[from];
      result.known[to] = samples.known[from];
    }
  }
  for (const auto& [ends, contact] : samples.contacts)
    if (vertex_now[ends.first] != nowhere && vertex_now[ends.second] != nowhere)
      result.contacts[{vertex_now[ends.first], vertex_now[ends.second]}] = contact;
  return result;
}

} // namespace meninas
