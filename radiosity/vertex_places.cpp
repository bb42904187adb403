#include "radiosity/vertex_places.h"

#include <cmath>
#include <numbers>

namespace meninas {

Point3 centre_of(const ElementMesh& mesh, ElementId element) {
  const auto& corners = mesh.corners[index(element)];
  const int count = corners[3] == corners[2] ? 3 : 4;
  Point3 sum(0.0);
  for (int c = 0; c < count; ++c)
    sum += mesh.vertices[index(corners[static_cast<std::size_t>(c)])];
  return sum / double(count);
}

std::vector<Rgb> corner_means(const ElementMesh& mesh, std::span<const glm::vec3> values) {
  std::vector<Rgb> means(element_count(mesh));
  for (std::size_t e = 0; e < means.size(); ++e) {
    const ElementCorners& corners = mesh.corners[e];
    const std::size_t count = corners[3] == corners[2] ? 3 : 4;
    Rgb sum(0.0);
    for (std::size_t c = 0; c < count; ++c)
      sum += Rgb(values[index(corners[c])]);
    means[e] = sum / double(count);
  }
  return means;
}

VertexElements elements_around(const ElementMesh& mesh) {
  VertexElements around;
  around.begin.assign(mesh.vertices.size() + 1, 0);
  const auto for_each_corner = [&mesh](auto&& visit) {
    for (std::size_t e = 0; e < mesh.corners.size(); ++e) {
      const auto& corners = mesh.corners[e];
      for (std::size_t c = 0; c < (corners[3] == corners[2] ? 3U : 4U); ++c)
        visit(static_cast<ElementId>(e), corners[c]);
    }
  };
  for_each_corner([&](ElementId, ElementVertexId vertex) { ++around.begin[index(vertex) + 1]; });
  for (std::size_t v = 1; v < around.begin.size(); ++v)
    around.begin[v] += around.begin[v - 1];
  around.elements.resize(around.begin.back());
  auto place = around.begin;
  for_each_corner([&](ElementId element, ElementVertexId vertex) {
    around.elements[place[index(vertex)]++] = element;
  });
  return around;
}

/// The angle of an element at one of its corners.
static double angle_at(const ElementMesh& mesh, ElementId element, std::size_t vertex) {
  const ElementCorners& corners = mesh.corners[index(element)];
  const std::size_t count = corners[3] == corners[2] ? 3 : 4;
  for (std::size_t c = 0; c < count; ++c) {
    if (index(corners[c]) != vertex)
      continue;
    const Point3& at = mesh.vertices[vertex];
    const Vec3 a = mesh.vertices[index(corners[(c + 1) % count])] - at,
               b = mesh.vertices[index(corners[(c + count - 1) % count])] - at;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }
  return 0.0;
}

/// The vertex itself where elements surround it, of whatever sizes.
static Point3 gathering_point(const ElementMesh& mesh, const VertexElements& all,
                              std::size_t vertex) {
  constexpr double inset = 0.02;
  const auto elements = around(all, vertex);
  constexpr double nearly_all = 2.0 * std::numbers::pi - 1e-3;
  Point3 centre(0.0);
  double angle = 0.0;
  for (const ElementId element : elements) {
    centre += centre_of(mesh, element) / double(elements.size());
    angle += angle_at(mesh, element, vertex);
  }
  if (angle > nearly_all)
    return mesh.vertices[vertex];
  return glm::mix(mesh.vertices[vertex], centre, inset);
}

std::vector<Receiver> vertex_receivers(const ElementMesh& mesh) {
  return vertex_receivers(mesh, elements_around(mesh));
}

std::vector<Receiver> vertex_receivers(const ElementMesh& mesh, const VertexElements& all) {
  std::vector<Receiver> receivers;
  receivers.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const MeshSide& side =
        mesh.sides[index(mesh.side_of_element[index(mesh.element_of_vertex[v])])];
    receivers.push_back(
        {gathering_point(mesh, all, v), side.normal, side.plane_class, side.tangent, side.coat});
  }
  return receivers;
}

} // namespace meninas
