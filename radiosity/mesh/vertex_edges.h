// The edges of elements by their vertices, and which go on from one another:
// along these, values at vertices have second differences.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <span>
#include <vector>

namespace meninas {

/// The other ends of every vertex's edges, by ElementVertexId.
struct VertexEdges {
  std::vector<std::uint32_t> begin; ///< vertices + 1
  std::vector<std::uint32_t> ends;

  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return std::span(ends).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
  }
};
VertexEdges edges_of(const ElementMesh& mesh);

/// Two edges from a vertex, of which the second goes on from the first:
/// the cosine between them is -0.9 and less.
bool are_in_line(const Vec3& to_a, const Vec3& to_b);

/// The second derivative at v along two edges that go on, to a and to b.
template <typename Value>
Value second_derivative(const ElementMesh& mesh, std::span<const Value> values, std::size_t v,
                        std::size_t a, std::size_t b) {
  using Number = typename Value::value_type;
  const double to_a = glm::distance(mesh.vertices[a], mesh.vertices[v]),
               to_b = glm::distance(mesh.vertices[b], mesh.vertices[v]);
  const Value slope = (values[a] - values[v]) / static_cast<Number>(to_a) +
                      (values[b] - values[v]) / static_cast<Number>(to_b);
  return slope * static_cast<Number>(2.0 / (to_a + to_b));
}

} // namespace meninas
