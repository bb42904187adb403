#include "radiosity/field/curved_means.h"

#include "radiosity/field/vertex_places.h"

#include <algorithm>

namespace meninas {

namespace {

/// A sum of s^2 f'' along edges of one direction, and of how many ends of these.
struct Curvature {
  Rgb sum{0.0};
  int ends = 0;
};

/// Adds what there is along the edge from v to a, at v.
void add_at(const ElementMesh& mesh, const VertexEdges& edges, std::span<const glm::vec3> values,
            std::uint32_t v, std::uint32_t a, Curvature& curvature) {
  const Vec3 to_a = mesh.vertices[a] - mesh.vertices[v];
  for (const std::uint32_t b : edges.of(v))
    if (are_in_line(to_a, mesh.vertices[b] - mesh.vertices[v])) {
      curvature.sum += glm::dot(to_a, to_a) * second_derivative(mesh, values, v, a, b);
      ++curvature.ends;
      return;
    }
}

} // namespace

std::vector<Rgb> curved_means(const ElementMesh& mesh, const VertexEdges& edges,
                              std::span<const glm::vec3> values) {
  std::vector<Rgb> means = corner_means(mesh, values);
  for (std::size_t e = 0; e < means.size(); ++e) {
    const ElementCorners& corners = mesh.corners[e];
    if (corners[2] == corners[3] || region_of(mesh, static_cast<ElementId>(e)) != nullptr)
      continue;
    for (const std::size_t way : {0U, 1U}) {
      Curvature curvature;
      for (const std::size_t c : {way, way + 2}) {
        const std::uint32_t a = index(corners[c]), b = index(corners[(c + 1) % 4]);
        if (a == b)
          continue;
        add_at(mesh, edges, values, a, b, curvature);
        add_at(mesh, edges, values, b, a, curvature);
      }
      if (curvature.ends > 0)
        means[e] -= curvature.sum / (12.0 * curvature.ends);
    }
    glm::vec3 largest_corner(0.0F);
    for (const ElementVertexId corner : corners)
      largest_corner = glm::max(largest_corner, values[index(corner)]);
    means[e] = glm::clamp(means[e], Rgb(0.0), 2.0 * Rgb(largest_corner));
  }
  return means;
}

} // namespace meninas
