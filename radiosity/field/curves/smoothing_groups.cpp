#include "radiosity/field/curves/smoothing_groups.h"

#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/mesh/mesh_cells.h"
#include "radiosity/mesh/vertex_welder.h"
#include "radiosity/scene/small_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// Small enough for a mean over its neighbours to be as fine as the mesh is elsewhere.
bool is_facet(const ElementMesh& mesh, const MeshSide& side) {
  constexpr double largest = 0.25; // of an element
  return side.element_count == 1 &&
         mesh.area[side.first_element] <= largest * side.element_size * side.element_size;
}

const MeshSide& side_of(const ElementMesh& mesh, ElementId element) {
  return mesh.sides[index(mesh.side_of_element[index(element)])];
}

/// Corners of facets by the place they are at, as lists of vertices.
std::vector<std::vector<ElementVertexId>> facet_places(const ElementMesh& mesh, double grain) {
  VertexWelder welder(grain);
  std::vector<Point3> places;
  std::vector<std::vector<ElementVertexId>> at_place;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_facet(mesh, side_of(mesh, mesh.element_of_vertex[v])))
      continue;
    const std::size_t place = index(welder.vertex_at(0, mesh.vertices[v], places));
    at_place.resize(places.size());
    at_place[place].push_back(static_cast<ElementVertexId>(v));
  }
  return at_place;
}

/// What tells at a corner of a facet whether another one continues it.
struct CornerNormal {
  Direction normal{0.0};
  bool given = false; ///< by the file; else it is that of the facet
};

CornerNormal corner_normal(const LightScene& light, ElementVertexId v) {
  const MeshSide& side = side_of(light.mesh, light.mesh.element_of_vertex[index(v)]);
  if (const auto given = given_normal(light, side, light.mesh.vertices[index(v)]))
    return {*given, true};
  return {side.normal, false};
}

/// Where the file gives normals they are the same on both sides of what is smooth.
bool is_smooth_between(const CornerNormal& a, const CornerNormal& b) {
  const double turn = a.given && b.given ? same_normal_degrees : max_facet_turn;
  return glm::dot(a.normal, b.normal) >= std::cos(turn * std::numbers::pi / 180.0);
}

} // namespace

VertexElements facets_around(const LightScene& light) {
  const ElementMesh& mesh = light.mesh;
  constexpr std::size_t min_facets = 3;
  const VertexElements own = elements_around(mesh);
  std::vector<std::vector<ElementId>> taken(mesh.vertices.size());
  const auto places = facet_places(mesh, vertex_grain(mesh, light.surfaces));
  std::vector<CornerNormal> normals(mesh.vertices.size());
  for (const auto& vertices : places)
    for (const ElementVertexId v : vertices)
      normals[index(v)] = corner_normal(light, v);
  for (const auto& vertices : places) {
    if (vertices.size() < min_facets)
      continue;
    for (const ElementVertexId v : vertices) {
      std::vector<ElementId>& facets = taken[index(v)];
      std::size_t surfaces = 0;
      for (const ElementVertexId other : vertices) {
        if (!is_smooth_between(normals[index(v)], normals[index(other)]))
          continue;
        ++surfaces;
        const auto elements = around(own, index(other));
        facets.insert(facets.end(), elements.begin(), elements.end());
      }
      if (surfaces < min_facets)
        facets.clear();
    }
  }
  for (std::size_t v = 0; v < taken.size(); ++v) {
    const auto elements = around(own, v);
    if (taken[v].empty() && std::ranges::all_of(elements, [&](ElementId element) {
          return needs_few_samples(light, element);
        }))
      taken[v].assign(elements.begin(), elements.end());
  }
  VertexElements result;
  result.begin.push_back(0);
  for (const auto& facets : taken) {
    result.elements.insert(result.elements.end(), facets.begin(), facets.end());
    result.begin.push_back(static_cast<std::uint32_t>(result.elements.size()));
  }
  return result;
}

std::vector<std::uint8_t> sides_above_crease_angle(const ElementMesh& mesh, const VertexElements& facets,
                                          double degrees) {
  const double min_cosine = std::cos(degrees * std::numbers::pi / 180.0);
  std::vector<std::uint8_t> turn(mesh.sides.size(), 0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const SideId own = mesh.side_of_element[index(mesh.element_of_vertex[v])];
    for (const ElementId facet : around(facets, v))
      if (glm::dot(mesh.sides[index(own)].normal, side_of(mesh, facet).normal) < min_cosine)
        turn[index(own)] = 1;
  }
  return turn;
}

std::vector<std::uint8_t> averaged_facets(const ElementMesh& mesh, const VertexElements& facets) {
  std::vector<std::uint8_t> averaged(element_count(mesh), 0);
  for (const ElementId facet : facets.elements)
    averaged[index(facet)] = 1;
  return averaged;
}

glm::vec3 facet_mean(const ElementMesh& mesh, std::span<const ElementId> facets,
                     std::span<const Rgb> irradiance, std::span<const Rgb> values) {
  Rgb sum(0.0);
  double area = 0.0;
  for (const ElementId facet : facets) {
    if (irradiance[index(facet)] == Rgb(0.0))
      continue;
    sum += mesh.area[index(facet)] * values[index(facet)];
    area += mesh.area[index(facet)];
  }
  return area > 0.0 ? glm::vec3(sum / area) : glm::vec3(0.0F);
}

} // namespace meninas
