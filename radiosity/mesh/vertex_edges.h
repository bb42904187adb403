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

/// The second derivative at v along two edges that go on, to a and to b, in the values' unit over m^2:
///   f'' = 2 ((f_a - f_v) / |a - v| + (f_b - f_v) / |b - v|) / (|a - v| + |b - v|).
Rgb second_derivative(const ElementMesh& mesh, std::span<const glm::vec3> values, std::size_t v,
                      std::size_t a, std::size_t b);

} // namespace meninas
