#include "radiosity/field/contact_vertices.h"

#include <algorithm>
#include <map>

namespace meninas {

std::vector<ContactEdge> contact_edges(const ElementMesh& mesh,
                                       std::span<const std::uint8_t> valid) {
  enum class State : std::uint8_t { covered, exposed, neither };
  std::vector<State> states;
  for (const std::uint8_t is_valid : valid)
    states.push_back(is_valid != 0 ? State::exposed : State::covered);
  for (const HangingVertex& hanging : mesh.hanging) {
    const bool both = states[index(hanging.end_a)] == State::exposed &&
                      states[index(hanging.end_b)] == State::exposed;
    states[index(hanging.vertex)] = both ? State::exposed : State::neither;
  }
  std::vector<ContactEdge> edges;
  const auto add_edge = [&](std::uint32_t v, std::uint32_t n) {
    if (states[v] == State::covered && states[n] == State::exposed)
      edges.push_back({v, n});
  };
  for (const ElementCorners& corners : mesh.corners)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = index(corners[c]), b = index(corners[(c + 1) % 4]);
      add_edge(a, b);
      add_edge(b, a);
    }
  // Two elements share most edges.
  const auto ends = [](const ContactEdge& edge) { return std::pair(edge.covered, edge.exposed); };
  std::ranges::sort(edges, {}, ends);
  const auto same = std::ranges::unique(edges, {}, ends);
  edges.erase(same.begin(), same.end());
  return edges;
}

double contact_place(const Receiver& exposed, const Point3& covered,
                     const std::function<bool(const Receiver&)>& is_open) {
  // Halves of what is not yet decided, to a sixty-fourth of the edge.
  constexpr int halvings = 6;
  Receiver point = exposed;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    point.position = glm::mix(exposed.position, covered, middle);
    (is_open(point) ? low : high) = middle;
  }
  // At two thirds of the exposed part:
  // the line through there and the exposed end has the mean of any parabola over it (Radau's rule),
  // and is not led astray by what is much narrower than an element.
  return 2.0 / 3.0 * low;
}

ContactLight light_at_contact(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const GatheringPoint& exposed, const Point3& covered,
                              PointWorkspace& work) {
  const double place = contact_place(exposed.receiver, covered, [&](const Receiver& point) {
    return is_open(gathering, irradiance, {point, exposed.element_size, exposed.seed}, work);
  });
  if (place == 0.0)
    return {0.0, {}};
  Receiver point = exposed.receiver;
  point.position = glm::mix(exposed.receiver.position, covered, place);
  const VertexValue value =
      value_at(gathering, irradiance, {point, exposed.element_size, exposed.seed}, work);
  return {value.clearance == Clearance::open ? place : 0.0, value};
}

void ContactLines::add(const ArrivingLight& seen, const ArrivingLight& beside, double place) {
  // The closer n and p are, the more of their noise the line carries to v.
  const double weight = place * place, step = std::min((1.0 - place) / place, 2.0);
  // No light is less than nothing, no part more than the whole. A part is never held to that
  // by itself, so that the whole is what it would be if what mirrors show were there.
  const auto line = [&](const Rgb& n, const Rgb& p) { return p + step * (p - n); };
  const Rgb total = glm::max(line(seen.total, beside.total), 0.0);
  sum_.total += weight * total;
  sum_.mirrored += weight * glm::clamp(line(seen.mirrored, beside.mirrored), Rgb(0.0), total);
  weights_ += weight;
}

ArrivingLight ContactLines::mean() const {
  return {sum_.total / weights_, sum_.mirrored / weights_};
}

static ArrivingLight without(const ArrivingLight& light, const ArrivingLight& part) {
  return {light.total - part.total, light.mirrored - part.mirrored};
}

void extend_to_contacts(std::span<const ContactEdge> edges, std::span<const ContactLight> lights,
                        std::vector<std::uint8_t>& valid, VertexIrradiance& field) {
  struct Lines {
    ContactLines direct, indirect;
  };
  std::map<std::uint32_t, Lines> lines_to;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto& [place, value] = lights[k];
    if (place == 0.0)
      continue;
    const std::uint32_t n = edges[k].exposed;
    const ArrivingLight all{Rgb(field.irradiance[n]), Rgb(field.mirrored[n])},
        seen{Rgb(field.indirect[n]), Rgb(field.indirect_mirrored[n])};
    Lines& lines = lines_to[edges[k].covered];
    lines.indirect.add(seen, value.indirect, place);
    lines.direct.add(without(all, seen), without(value.irradiance, value.indirect), place);
  }
  for (const auto& [v, lines] : lines_to) {
    const ArrivingLight indirect = lines.indirect.mean(), all = indirect + lines.direct.mean();
    field.indirect[v] = glm::vec3(indirect.total);
    field.indirect_mirrored[v] = glm::vec3(indirect.mirrored);
    field.irradiance[v] = glm::vec3(all.total);
    field.mirrored[v] = glm::vec3(all.mirrored);
    valid[v] = 1;
  }
}

void extend_over_regions(const ElementMesh& mesh, std::span<const Receiver> receivers,
                         std::vector<std::uint8_t>& valid, VertexIrradiance& field) {
  std::vector<ContactEdge> edges;
  std::vector<ContactLight> lights;
  for (std::uint32_t e = 0; e < element_count(mesh); ++e) {
    const RegionElement* region = region_of(mesh, ElementId{e});
    if (region == nullptr)
      continue;
    const ElementCorners& corners = mesh.corners[e];
    const std::size_t count = corners[3] == corners[2] ? 3 : 4;
    const auto is_own = [&](std::size_t c) { return ((region->own_corners >> c) & 1U) != 0; };
    for (std::size_t c = 0; c < count; ++c)
      for (const std::size_t beside : {(c + 1) % count, (c + count - 1) % count}) {
        const std::uint32_t v = index(corners[c]), n = index(corners[beside]);
        if (is_own(c) || !is_own(beside) || valid[v] == 0 || valid[n] == 0)
          continue;
        const Vec3 way = mesh.vertices[v] - mesh.vertices[n];
        const Vec3 to = receivers[v].position - mesh.vertices[n];
        const double place = glm::dot(to, way) / glm::dot(way, way);
        // The edge on which light is gathered for the vertex (vertex_places.h).
        if (!(place > 0.0 && place < 1.0 &&
              glm::distance(to, place * way) < 0.05 * glm::length(way)))
          continue;
        edges.push_back({v, n});
        lights.push_back(
            {place,
             {{Rgb(field.irradiance[v]), Rgb(field.mirrored[v])},
              {Rgb(field.indirect[v]), Rgb(field.indirect_mirrored[v])}}});
      }
  }
  extend_to_contacts(edges, lights, valid, field);
}

} // namespace meninas
