#include "radiosity/field/curves/smoothing_groups.h"

#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/mesh/mesh_cells.h"
#include "radiosity/mesh/vertex_welder.h"
#include "radiosity/scene/small_elements.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

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

/// Corners of facets, sorted by the place they are at.
struct FacetPlaces {
  std::vector<std::uint32_t> begin{0}; ///< by place, and the end
  std::vector<ElementVertexId> vertices;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const ElementVertexId> at(std::size_t place) const {
    return std::span(vertices).subspan(begin[place], begin[place + 1] - begin[place]);
  }
};

FacetPlaces facet_places(const ElementMesh& mesh, double grain) {
  VertexWelder welder(grain);
  std::vector<Point3> places;
  std::vector<std::pair<std::uint32_t, ElementVertexId>> found;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (is_facet(mesh, side_of(mesh, mesh.element_of_vertex[v])))
      found.emplace_back(index(welder.vertex_at(0, mesh.vertices[v], places)),
                         static_cast<ElementVertexId>(v));
  FacetPlaces sorted;
  sorted.begin.resize(places.size() + 1, 0);
  for (const auto& [place, vertex] : found)
    ++sorted.begin[place + 1];
  std::partial_sum(sorted.begin.begin(), sorted.begin.end(), sorted.begin.begin());
  sorted.vertices.resize(found.size());
  std::vector<std::uint32_t> next = sorted.begin;
  for (const auto& [place, vertex] : found)
    sorted.vertices[next[place]++] = vertex;
  return sorted;
}

/// The data at a corner of a facet that say whether another facet continues it.
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
  static const double same_cosine = std::cos(same_normal_degrees * std::numbers::pi / 180.0),
                      facet_cosine = std::cos(max_facet_turn * std::numbers::pi / 180.0);
  return glm::dot(a.normal, b.normal) >= (a.given && b.given ? same_cosine : facet_cosine);
}

/// The search for the facets around each vertex.
class FacetSearch {
public:
  explicit FacetSearch(const LightScene& light)
      : light_(light), own_(elements_around(light.mesh)),
        places_(facet_places(light.mesh, vertex_grain(light.mesh, light.surfaces))),
        normals_(light.mesh.vertices.size()) {
    tbb::parallel_for(std::size_t{0}, places_.vertices.size(), [&](std::size_t k) {
      const ElementVertexId v = places_.vertices[k];
      normals_[index(v)] = corner_normal(light, v);
    });
  }

  /// Counts, then lists.
  VertexElements find() const {
    const std::size_t vertices = light_.mesh.vertices.size();
    VertexElements result;
    result.begin.assign(vertices + 1, 0);
    for_each_corner([&](ElementVertexId v, std::span<const ElementVertexId> beside) {
      for (const ElementVertexId other : beside)
        result.begin[index(v) + 1] += static_cast<std::uint32_t>(around(own_, index(other)).size());
    });
    std::vector<std::uint8_t> alone(vertices, 0);
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      const auto elements = around(own_, v);
      if (result.begin[v + 1] != 0 || !std::ranges::all_of(elements, [&](ElementId element) {
            return has_reduced_samples(light_, element);
          }))
        return;
      alone[v] = 1;
      result.begin[v + 1] = static_cast<std::uint32_t>(elements.size());
    });
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.elements.resize(result.begin.back());
    for_each_corner([&](ElementVertexId v, std::span<const ElementVertexId> beside) {
      auto to = result.elements.begin() + result.begin[index(v)];
      for (const ElementVertexId other : beside)
        to = std::ranges::copy(around(own_, index(other)), to).out;
    });
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      if (alone[v] != 0)
        std::ranges::copy(around(own_, v), result.elements.begin() + result.begin[v]);
    });
    return result;
  }

private:
  /// Calls `use(vertex, vertices that stand for the facets which continue its own)`.
  template <typename Use>
  void for_each_corner(const Use& use) const {
    constexpr std::size_t min_facets = 3;
    tbb::parallel_for(std::size_t{0}, places_.size(), [&](std::size_t place) {
      const auto vertices = places_.at(place);
      if (vertices.size() < min_facets)
        return;
      std::vector<ElementVertexId> beside;
      for (const ElementVertexId v : vertices) {
        beside.clear();
        for (const ElementVertexId other : vertices)
          if (is_smooth_between(normals_[index(v)], normals_[index(other)]))
            beside.push_back(other);
        if (beside.size() >= min_facets)
          use(v, std::span<const ElementVertexId>(beside));
      }
    });
  }

  const LightScene& light_;
  VertexElements own_;
  FacetPlaces places_;
  std::vector<CornerNormal> normals_;
};

} // namespace

VertexElements facets_around(const LightScene& light) { return FacetSearch(light).find(); }

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
