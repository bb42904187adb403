#include "radiosity/solution/element_triangles.h"

#include "scenes/surfaces/surfaces.h"

#include <algorithm>
#include <map>

namespace meninas {

namespace {

/// Hanging vertices by the ends of their edges, the smaller number first.
using EdgeMiddles = std::map<std::array<std::uint32_t, 2>, std::uint32_t>;

std::array<std::uint32_t, 2> edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The corners of an element and the vertices that hang on its edges, in order,
/// one of the latter first if there is one: a fan from it has no triangle without area.
std::vector<std::uint32_t> outline_of(const ElementCorners& corners, const EdgeMiddles& middles) {
  const std::size_t count = corners[3] == corners[2] ? 3 : 4;
  std::vector<std::uint32_t> outline;
  std::ptrdiff_t first = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t a = index(corners[k]), b = index(corners[(k + 1) % count]);
    outline.push_back(a);
    if (const auto middle = middles.find(edge_of(a, b)); middle != middles.end()) {
      first = std::ssize(outline);
      outline.push_back(middle->second);
    }
  }
  std::rotate(outline.begin(), outline.begin() + first, outline.end());
  return outline;
}

} // namespace

namespace {

/// The share of a point's value that every corner of its element has.
std::array<float, 4> weights_at(const ElementMesh& mesh, ElementId element, const Point3& x) {
  const ElementCorners& corners = mesh.corners[index(element)];
  Patch leaf;
  leaf.corner_count = corners[3] == corners[2] ? 3 : 4;
  for (std::size_t c = 0; c < 4; ++c)
    leaf.corners[c] = mesh.vertices[index(corners[c])];
  const Vec2 uv = uv_at(leaf, x);
  const auto s = static_cast<float>(uv.x), t = static_cast<float>(uv.y);
  if (leaf.corner_count == 3)
    return {1.0F - s - t, s, t, 0.0F};
  return {(1.0F - s) * (1.0F - t), s * (1.0F - t), s * t, (1.0F - s) * t};
}

/// The triangles of a region turn as its own light sees them.
void add_region(const ElementMesh& mesh, ElementId element, const RegionElement& region,
                ElementTriangles& to) {
  to.elements.insert(to.elements.end(), region.triangles.size(), element);
  for (const auto& triangle : region.triangles)
    for (const Point3& x : triangle) {
      to.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size() + to.points.size()));
      to.points.push_back({x, element, weights_at(mesh, element, x)});
    }
}

} // namespace

ElementTriangles element_triangles(const ElementMesh& mesh) {
  EdgeMiddles middles;
  for (const HangingVertex& h : mesh.hanging)
    middles.emplace(edge_of(index(h.end_a), index(h.end_b)), index(h.vertex));
  ElementTriangles triangles;
  for (std::size_t e = 0; e < mesh.corners.size(); ++e) {
    if (const RegionElement* region = region_of(mesh, static_cast<ElementId>(e))) {
      add_region(mesh, static_cast<ElementId>(e), *region, triangles);
      continue;
    }
    const bool back = mesh.sides[index(mesh.side_of_element[e])].facing == Facing::back;
    const std::vector<std::uint32_t> outline = outline_of(mesh.corners[e], middles);
    for (std::size_t k = 2; k < outline.size(); ++k) {
      triangles.indices.insert(triangles.indices.end(),
                               {outline[0], outline[back ? k : k - 1], outline[back ? k - 1 : k]});
      triangles.elements.push_back(static_cast<ElementId>(e));
    }
  }
  return triangles;
}

} // namespace meninas
