#include "radiosity/mesh/vertex_edges.h"

#include <algorithm>

namespace meninas {

/// `edge(a, b)` for the edges of all elements, both ways, those that two elements share twice.
template <typename Use>
static void for_each_edge(const ElementMesh& mesh, const Use& edge) {
  for (const ElementCorners& corners : mesh.corners)
    for (std::size_t c = 0; c < 4; ++c)
      if (const auto a = index(corners[c]), b = index(corners[(c + 1) % 4]); a != b) {
        edge(a, b);
        edge(b, a);
      }
}

VertexEdges edges_of(const ElementMesh& mesh) {
  std::vector<std::uint32_t> first(mesh.vertices.size() + 1, 0);
  for_each_edge(mesh, [&](std::uint32_t a, std::uint32_t) { ++first[a + 1]; });
  for (std::size_t v = 1; v < first.size(); ++v)
    first[v] += first[v - 1];
  std::vector<std::uint32_t> ends(first.back()), next = first;
  for_each_edge(mesh, [&](std::uint32_t a, std::uint32_t b) { ends[next[a]++] = b; });

  VertexEdges edges{{0}, {}};
  edges.ends.reserve(ends.size() / 2);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto own = std::span(ends).subspan(first[v], first[v + 1] - first[v]);
    std::ranges::sort(own);
    edges.ends.insert(edges.ends.end(), own.begin(), std::ranges::unique(own).begin());
    edges.begin.push_back(static_cast<std::uint32_t>(edges.ends.size()));
  }
  return edges;
}

bool are_in_line(const Vec3& to_a, const Vec3& to_b) {
  constexpr double straight = -0.9;
  const double along = glm::dot(to_a, to_b);
  return along < 0.0 &&
         along * along > straight * straight * glm::dot(to_a, to_a) * glm::dot(to_b, to_b);
}

Rgb second_derivative(const ElementMesh& mesh, std::span<const glm::vec3> values, std::size_t v,
                      std::size_t a, std::size_t b) {
  const double to_a = glm::distance(mesh.vertices[a], mesh.vertices[v]),
               to_b = glm::distance(mesh.vertices[b], mesh.vertices[v]);
  // Floats would not hold slopes of bright light in a tiny scene.
  const Rgb here(values[v]);
  return 2.0 / (to_a + to_b) * ((Rgb(values[a]) - here) / to_a + (Rgb(values[b]) - here) / to_b);
}

} // namespace meninas
