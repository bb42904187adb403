#include "radiosity/contact_vertices.h"

#include <algorithm>

namespace meninas {

std::vector<ContactEdge> contact_edges(const ElementMesh& mesh,
                                       std::span<const std::uint8_t> valid) {
  std::vector<ContactEdge> edges;
  for (const ElementCorners& corners : mesh.corners)
    for (std::size_t c = 0; c < 4; ++c) {
      const auto a = index(corners[c]), b = index(corners[(c + 1) % 4]);
      if (valid[a] != valid[b])
        edges.push_back(valid[a] == 0 ? ContactEdge{a, b} : ContactEdge{b, a});
    }
  // Two elements share most edges.
  const auto ends = [](const ContactEdge& edge) { return std::pair(edge.covered, edge.exposed); };
  std::ranges::sort(edges, {}, ends);
  const auto same = std::ranges::unique(edges, {}, ends);
  edges.erase(same.begin(), same.end());
  return edges;
}

ContactLight light_at_contact(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const Receiver& exposed, const Point3& covered, double element_size,
                              std::uint32_t seed, PointWorkspace& work) {
  // Halves of what is not yet decided, to a sixty-fourth of the edge.
  constexpr int halvings = 6;
  Receiver point = exposed;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    point.position = glm::mix(exposed.position, covered, middle);
    (is_open(gathering, irradiance, point, element_size, seed, work) ? low : high) = middle;
  }
  // At two thirds of the exposed part: the line through there and the exposed end has the mean of any parabola over it (Radau's rule), and
  // is not led astray by what is much narrower than an element.
  const double place = 2.0 / 3.0 * low;
  if (place == 0.0)
    return {0.0, {}};
  point.position = glm::mix(exposed.position, covered, place);
  const VertexValue value = value_at(gathering, irradiance, point, element_size, seed, work);
  return {value.covered ? 0.0 : place, value};
}

namespace {

/// Light and the part of it that comes by way of mirrors.
struct Split {
  glm::vec3 all{0.0F}, mirrored{0.0F};
};

/// The line through what is seen at n and at p, at v: no light is less than nothing, no part more than the whole. A part is never held to that by
/// itself, so that the whole is what it would be if what mirrors show were there.
Split beyond(const Split& seen, const Split& beside, float step) {
  const auto line = [&](const glm::vec3& n, const glm::vec3& p) { return p + step * (p - n); };
  const glm::vec3 all = glm::max(line(seen.all, beside.all), 0.0F);
  return {all, glm::clamp(line(seen.mirrored, beside.mirrored), glm::vec3(0.0F), all)};
}

void add(Split& sum, float weight, const Split& light) {
  sum.all += weight * light.all;
  sum.mirrored += weight * light.mirrored;
}

Split without(const Split& light, const Split& part) {
  return {light.all - part.all, light.mirrored - part.mirrored};
}

Split split(const ArrivingLight& light) { return {light.total, light.mirrored}; }

} // namespace

void extend_to_contacts(std::span<const ContactEdge> edges, std::span<const ContactLight> lights,
                        std::vector<std::uint8_t>& valid, DiffuseField& field) {
  for (std::size_t first = 0; first < edges.size();) {
    const std::uint32_t v = edges[first].covered;
    Split direct, indirect;
    float weights = 0.0F;
    for (; first < edges.size() && edges[first].covered == v; ++first) {
      const std::uint32_t n = edges[first].exposed;
      const auto& [place, value] = lights[first];
      if (place == 0.0)
        continue;
      // The closer n and p are, the more of their noise the line carries to v.
      const auto weight = static_cast<float>(place * place);
      const auto step = static_cast<float>(std::min((1.0 - place) / place, 2.0));
      const Split all{field.irradiance[n], field.mirrored[n]},
          seen{field.indirect[n], field.indirect_mirrored[n]};
      const Split all_beside = split(value.irradiance), beside = split(value.indirect);
      add(indirect, weight, beyond(seen, beside, step));
      add(direct, weight, beyond(without(all, seen), without(all_beside, beside), step));
      weights += weight;
    }
    if (weights == 0.0F)
      continue;
    field.indirect[v] = indirect.all / weights;
    field.indirect_mirrored[v] = indirect.mirrored / weights;
    field.irradiance[v] = (direct.all + indirect.all) / weights;
    field.mirrored[v] = (direct.mirrored + indirect.mirrored) / weights;
    valid[v] = 1;
  }
}

} // namespace meninas
