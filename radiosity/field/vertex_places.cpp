#include "radiosity/field/vertex_places.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meninas {

Point3 centre_of(const ElementMesh& mesh, ElementId element) {
  if (const RegionElement* region = region_of(mesh, element))
    return region->centroid;
  const auto& corners = mesh.corners[index(element)];
  const int count = corners[3] == corners[2] ? 3 : 4;
  Point3 sum(0.0);
  for (int c = 0; c < count; ++c)
    sum += mesh.vertices[index(corners[static_cast<std::size_t>(c)])];
  return sum / double(count);
}

std::vector<Rgb> corner_means(const ElementMesh& mesh, std::span<const glm::vec3> values) {
  std::vector<Rgb> means(element_count(mesh), Rgb(0.0));
  for (std::size_t e = 0; e < means.size(); ++e) {
    const ElementCorners& corners = mesh.corners[e];
    const std::size_t count = corners[3] == corners[2] ? 3 : 4;
    const RegionElement* region = region_of(mesh, static_cast<ElementId>(e));
    for (std::size_t c = 0; c < count; ++c)
      means[e] += (region != nullptr ? region->corner_weights[c] : 1.0 / double(count)) *
                  Rgb(values[index(corners[c])]);
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

/// The point of a triangle nearest to another in its plane.
static Point3 nearest_in(const std::array<Point3, 3>& triangle, const Point3& x) {
  const Vec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  bool inside = true;
  Point3 nearest = triangle[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Point3& a = triangle[k];
    const Vec3 edge = triangle[(k + 1) % 3] - a;
    inside = inside && glm::dot(glm::cross(edge, x - a), normal) >= 0.0;
    const double length2 = glm::dot(edge, edge);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(x - a, edge) / length2, 0.0, 1.0) : 0.0;
    if (glm::distance(a + t * edge, x) < glm::distance(nearest, x))
      nearest = a + t * edge;
  }
  return inside ? x : nearest;
}

Point3 nearest_in(const ElementMesh& mesh, ElementId element, const Point3& corner) {
  const RegionElement* region = region_of(mesh, element);
  if (region == nullptr || region->triangles.empty())
    return corner;
  Point3 nearest = region->triangles[0][0];
  for (const auto& triangle : region->triangles)
    if (const Point3 x = nearest_in(triangle, corner);
        glm::distance(x, corner) < glm::distance(nearest, corner))
      nearest = x;
  return nearest;
}

/// The extent of a region along the way from a to b, as a share of it.
static double reach_along(const RegionElement& region, const Point3& a, const Point3& b) {
  constexpr double aside = 1e-5;
  const Vec3 way = b - a;
  const double length2 = glm::dot(way, way);
  double reach = 0.0;
  for (const auto& triangle : region.triangles)
    for (const Point3& x : triangle) {
      const double t = glm::dot(x - a, way) / length2;
      if (glm::distance(x, a + t * way) <= aside * std::sqrt(length2))
        reach = std::max(reach, std::min(t, 1.0));
    }
  return reach;
}

constexpr double alike = 1e-6;

/// Whether a point has the lower coordinates, by more than rounding beside `length`.
static bool comes_before(const Point3& a, const Point3& b, double length) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(a[k] - b[k]) > alike * length)
      return a[k] < b[k];
  return false;
}

/// For a vertex beyond what cuts its elements: two thirds of the way to that from an own corner of
/// one of them. The line through both has the mean of any parabola over the way (Radau's rule), and
/// is not led astray by shadows much narrower than the element.
static std::optional<Point3> before_contact(const ElementMesh& mesh,
                                            std::span<const ElementId> elements,
                                            std::size_t vertex) {
  double longest = 0.0;
  std::optional<Point3> place;
  for (const ElementId element : elements) {
    const RegionElement* region = region_of(mesh, element);
    if (region == nullptr)
      continue;
    const ElementCorners& corners = mesh.corners[index(element)];
    const std::size_t count = corners[3] == corners[2] ? 3 : 4;
    const auto is_own = [&](std::size_t c) { return ((region->own_corners >> c) & 1U) != 0; };
    for (std::size_t c = 0; c < count; ++c) {
      if (index(corners[c]) != vertex || is_own(c))
        continue;
      for (const std::size_t beside : {(c + 1) % count, (c + count - 1) % count}) {
        const Point3 &from = mesh.vertices[index(corners[beside])], &to = mesh.vertices[vertex];
        const double reach = is_own(beside) ? reach_along(*region, from, to) : 0.0;
        const double length = reach * glm::distance(from, to);
        const Point3 there = glm::mix(from, to, 2.0 / 3.0 * reach);
        // If ways are equally long, to rounding, the choice does not depend on the order of elements.
        if (length > (1.0 + alike) * longest ||
            (length > (1.0 - alike) * longest && place && comes_before(there, *place, length))) {
          longest = length;
          place = there;
        }
      }
    }
  }
  return place;
}

/// The vertex itself where elements surround it, of whatever sizes.
/// Where something stands at it, or before it, light is gathered next to that.
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
  if (is_at_contact(mesh, vertex)) {
    if (const auto place = before_contact(mesh, elements, vertex))
      return glm::mix(*place, centre, inset);
    const Point3& corner = mesh.vertices[vertex];
    const ElementId nearest = *std::ranges::min_element(elements, {}, [&](ElementId element) {
      return glm::distance(nearest_in(mesh, element, corner), corner);
    });
    const Point3 beside = nearest_in(mesh, nearest, corner);
    if (beside == corner)
      return glm::mix(corner, centre, inset);
    return glm::mix(beside, centre_of(mesh, nearest), 2.0 / 3.0); // of a region without own corners
  }
  if (angle > nearly_all)
    return mesh.vertices[vertex];
  return glm::mix(mesh.vertices[vertex], centre, inset);
}

std::vector<Receiver> vertex_receivers(const ElementMesh& mesh) {
  return vertex_receivers(mesh, elements_around(mesh));
}

std::vector<Receiver> vertex_receivers(const ElementMesh& mesh, const VertexElements& all) {
  std::vector<Receiver> receivers(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, receivers.size(), [&](std::size_t v) {
    const MeshSide& side =
        mesh.sides[index(mesh.side_of_element[index(mesh.element_of_vertex[v])])];
    receivers[v] = {gathering_point(mesh, all, v), side.normal, side.plane_class, side.tangent,
                    side.coat};
  });
  return receivers;
}

} // namespace meninas
