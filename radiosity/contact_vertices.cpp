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
  // Halves of what is not yet decided, to a sixteenth of the edge.
  constexpr int halvings = 4;
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

/// The four parts of what arrives, none of which can be less than nothing: from the source and indirect, straight and by way of mirrors.
static std::array<glm::vec3, 4> parts_of(const glm::vec3& total, const glm::vec3& mirrored,
                                         const glm::vec3& indirect,
                                         const glm::vec3& indirect_mirrored) {
  const glm::vec3 direct_mirrored = mirrored - indirect_mirrored,
                  indirect_straight = indirect - indirect_mirrored;
  return {total - mirrored - indirect_straight, direct_mirrored, indirect_straight,
          indirect_mirrored};
}

void extend_to_contacts(std::span<const ContactEdge> edges, std::span<const ContactLight> lights,
                        std::vector<std::uint8_t>& valid, DiffuseField& field) {
  for (std::size_t first = 0; first < edges.size();) {
    const std::uint32_t v = edges[first].covered;
    std::array<glm::vec3, 4> sums{};
    float weights = 0.0F;
    for (; first < edges.size() && edges[first].covered == v; ++first) {
      const std::uint32_t n = edges[first].exposed;
      const auto& [place, value] = lights[first];
      if (place == 0.0)
        continue;
      // The line through the values at n and p, at v.
      const auto weight = static_cast<float>(place);
      const auto step = static_cast<float>(std::min((1.0 - place) / place, 2.0));
      const auto seen = parts_of(field.irradiance[n], field.mirrored[n], field.indirect[n],
                                 field.indirect_mirrored[n]);
      const auto beside =
          parts_of(glm::vec3(value.irradiance.total), glm::vec3(value.irradiance.mirrored),
                   glm::vec3(value.indirect.total), glm::vec3(value.indirect.mirrored));
      for (std::size_t part = 0; part < 4; ++part)
        sums[part] += weight * glm::max(beside[part] + step * (beside[part] - seen[part]), 0.0F);
      weights += weight;
    }
    if (weights == 0.0F)
      continue;
    const auto& [direct, direct_mirrored, indirect, indirect_mirrored] = sums;
    field.indirect_mirrored[v] = indirect_mirrored / weights;
    field.mirrored[v] = (direct_mirrored + indirect_mirrored) / weights;
    field.indirect[v] = (indirect + indirect_mirrored) / weights;
    field.irradiance[v] = (direct + direct_mirrored + indirect + indirect_mirrored) / weights;
    valid[v] = 1;
  }
}

} // namespace meninas
