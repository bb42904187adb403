// Vertices of the mesh: the elements around them, where light is gathered for them, and what lies
// between them, by (s, t) of an element with corners 0 to 3:
//
//   H(s, t) = (1 - t) ((1 - s) H_0 + s H_1) + t ((1 - s) H_3 + s H_2)      in quads
//   H(s, t) = (1 - s - t) H_0 + s H_1 + t H_2                              in triangles
//
// H in W/m^2, places in metres.
#pragma once

#include "radiosity/light/direct_irradiance.h"

#include <span>
#include <vector>

namespace meninas {

/// The elements around every vertex, in one list.
struct VertexElements {
  std::vector<std::uint32_t> begin; ///< vertices + 1
  std::vector<ElementId> elements;
};
VertexElements elements_around(const ElementMesh& mesh);

inline std::span<const ElementId> around(const VertexElements& all, std::size_t vertex) {
  return std::span(all.elements)
      .subspan(all.begin[vertex], all.begin[vertex + 1] - all.begin[vertex]);
}

/// The mean of an element's corners.
Point3 centre_of(const ElementMesh& mesh, ElementId element);

/// The point of an element nearest to one of its leaf: of a region that may be another place.
Point3 nearest_in(const ElementMesh& mesh, ElementId element, const Point3& x);

/// Where every vertex gathers, by ElementVertexId: drawn a little towards the middle of its
/// elements, so that it is inside its own surface and not in the wall that stands on its edge.
std::vector<Receiver> vertex_receivers(const ElementMesh& mesh);
/// The same where the elements around are at hand.
std::vector<Receiver> vertex_receivers(const ElementMesh& mesh, const VertexElements& all);

/// The mean of the values at its corners, by ElementId.
std::vector<Rgb> corner_means(const ElementMesh& mesh, std::span<const glm::vec3> values);

/// Between the corners of an element:
/// bilinear in quads, linear in triangles. `values` by ElementVertexId.
inline glm::vec3 value_in(const ElementMesh& mesh, std::span<const glm::vec3> values,
                          const ElementPoint& at) {
  const auto& corners = mesh.corners[index(at.element)];
  const auto value = [&](std::size_t c) { return values[index(corners[c])]; };
  const auto s = static_cast<float>(at.st.x), t = static_cast<float>(at.st.y);
  if (mesh.sides[index(mesh.side_of_element[index(at.element)])].triangle)
    return (1.0F - s - t) * value(0) + s * value(1) + t * value(2);
  return (1.0F - t) * ((1.0F - s) * value(0) + s * value(1)) +
         t * ((1.0F - s) * value(3) + s * value(2));
}

} // namespace meninas
