#include "radiosity/mesh/subdivision.h"

#include "radiosity/mesh/mesh_elements.h"
#include "radiosity/mesh/mesh_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <unordered_map>
#include <utility>

namespace meninas {

namespace {

/// The sides and root cells of a mesh, and nothing that follows from them.
ElementMesh roots_of(const ElementMesh& mesh) {
  ElementMesh roots;
  roots.sides = mesh.sides;
  roots.sides_of_patch = mesh.sides_of_patch;
  roots.element_size = mesh.element_size;
  roots.contacts = mesh.contacts;
  add_root_cells(roots);
  return roots;
}

constexpr std::array<Vec2, 4> quad_corners{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0),
                                           Vec2(0.0, 1.0)};
constexpr std::array<Vec2, 3> triangle_corners{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};

std::span<const Vec2> corners_of(const ElementMesh& mesh, const MeshCell& cell) {
  if (mesh.sides[index(cell.side)].triangle)
    return triangle_corners;
  return quad_corners;
}

/// Vertices by place, with the mesh and the surfaces they are of.
struct PlacedVertices {
  const ElementMesh& mesh;
  const SurfaceModel& surfaces;
  const VertexNumbers& vertices;

  /// The vertex at a share of the way along edge k of an element's cell, not one of its ends;
  /// none if there is none.
  ElementVertexId on_edge(const MeshCell& cell, std::size_t k, double share) const {
    const auto corners = corners_of(mesh, cell);
    const std::size_t next = (k + 1) % corners.size();
    const Vec2 st = glm::mix(corners[k], corners[next], share);
    const ElementVertexId found =
        vertices.find(surface_side(mesh, surfaces, cell), point_in(mesh, surfaces, cell, st));
    const ElementCorners& ends = mesh.corners[cell.first_element];
    return found == ends[k] || found == ends[next] ? none<ElementVertexId> : found;
  }
};

} // namespace

bool is_divisible(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshCell& leaf) {
  if (leaf.level >= max_levels)
    return false;
  const ElementCorners& corners = mesh.corners[leaf.first_element];
  // Corners may have become one vertex: then the area tells how long the edges are at least.
  const double longest = std::max(std::sqrt(leaf.area), longest_edge(mesh, corners));
  return leaf.area > 64.0 * vertex_grain(mesh, surfaces) * longest;
}

namespace {

/// By ElementVertexId, whether it is a corner of a divided cell's part.
std::vector<std::uint8_t> corners_of_parts(const ElementMesh& mesh) {
  std::vector<std::uint8_t> of_parts(mesh.vertices.size(), 0);
  for (std::uint32_t e = 0; e < element_count(mesh); ++e)
    if (cell_of(mesh, ElementId{e}).level > 0)
      for (const ElementVertexId corner : mesh.corners[e])
        of_parts[index(corner)] = 1;
  return of_parts;
}

/// Whether parts of cells in other patches may lie along an element's edges that are no halves of
/// them, as the division into roots may be another there.
bool has_unlike_neighbours(const ElementMesh& mesh, ElementId element,
                           std::span<const std::uint8_t> of_parts) {
  return is_at_border(mesh, cell_of(mesh, element)) &&
         std::ranges::any_of(mesh.corners[index(element)],
                             [&](ElementVertexId corner) { return of_parts[index(corner)] != 0; });
}

/// The elements at borders that have to be divided for the sake of neighbours in other patches,
/// which did not hang on them (with_followers() finds the others); empty when there is none.
std::vector<std::uint8_t> to_follow(const PlacedVertices& placed,
                                    std::span<const std::uint8_t> of_parts) {
  const ElementMesh& mesh = placed.mesh;
  std::vector<std::uint8_t> marked(element_count(mesh), 0);
  const auto has_much_smaller_neighbour = [&](const MeshCell& cell) {
    for (std::size_t k = 0; k < corners_of(mesh, cell).size(); ++k)
      for (const double quarter : {0.25, 0.75})
        if (placed.on_edge(cell, k, quarter) != none<ElementVertexId>)
          return true;
    return false;
  };
  for (std::uint32_t e = 0; e < marked.size(); ++e) {
    const MeshCell& cell = cell_of(mesh, ElementId{e});
    if (has_unlike_neighbours(mesh, ElementId{e}, of_parts) && has_much_smaller_neighbour(cell) &&
        is_divisible(mesh, placed.surfaces, cell))
      marked[e] = 1;
  }
  if (std::ranges::find(marked, 1) == marked.end())
    marked.clear();
  return marked;
}

/// Whether a place on the border of an element's leaf is on the element, which may be a region of it.
bool has_place(const ElementMesh& mesh, ElementId element, Vec2 st) {
  constexpr double inward = 1e-9;
  if (region_of(mesh, element) == nullptr)
    return true;
  const MeshCell& cell = cell_of(mesh, element);
  const Vec2 within = glm::mix(st, Vec2(1.0 / 3.0), inward);
  return locate(mesh, cell.side, patch_uv_of(mesh, cell, within)).element == element;
}

/// Vertices in the middle of edges. Where two cells of a patch differ along one, the smaller ones have
/// its ends for corners. Larger edges first:
/// the ends of a smaller one may hang on a larger one, never the other way round.
std::vector<HangingVertex> hanging_vertices(const PlacedVertices& placed,
                                            std::span<const std::uint8_t> of_parts) {
  struct Found {
    HangingVertex vertex;
    double edge;
  };
  const ElementMesh& mesh = placed.mesh;
  std::vector<Found> found;
  for (std::uint32_t e = 0; e < element_count(mesh); ++e) {
    const MeshCell& cell = cell_of(mesh, ElementId{e});
    const std::span<const Vec2> places = corners_of(mesh, cell);
    const std::size_t count = places.size();
    const bool all = has_unlike_neighbours(mesh, ElementId{e}, of_parts);
    for (std::size_t k = 0; k < count; ++k) {
      const ElementVertexId a = mesh.corners[e][k], b = mesh.corners[e][(k + 1) % count];
      if (!all && (of_parts[index(a)] == 0 || of_parts[index(b)] == 0))
        continue;
      const ElementVertexId middle = placed.on_edge(cell, k, 0.5);
      if (middle != none<ElementVertexId> &&
          has_place(mesh, ElementId{e}, 0.5 * (places[k] + places[(k + 1) % count])))
        found.push_back(
            {{middle, a, b}, glm::distance(mesh.vertices[index(a)], mesh.vertices[index(b)])});
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), &Found::edge);
  std::vector<HangingVertex> hanging;
  for (const Found& f : found)
    hanging.push_back(f.vertex);
  return hanging;
}

/// The elements on whose edges corners of smaller ones hang.
class LargerNeighbours {
public:
  explicit LargerNeighbours(const ElementMesh& mesh)
      : mesh_(mesh), edge_of_(mesh.vertices.size(), none_hangs) {
    std::vector<std::uint8_t> is_end(mesh.vertices.size(), 0);
    for (std::size_t k = 0; k < mesh.hanging.size(); ++k) {
      const HangingVertex& h = mesh.hanging[k];
      edge_of_[index(h.vertex)] = static_cast<std::uint32_t>(k);
      is_end[index(h.end_a)] = is_end[index(h.end_b)] = 1;
      element_at_.emplace(key_of(h.end_a, h.end_b), none<ElementId>);
    }
    for (std::size_t e = 0; e < element_count(mesh); ++e)
      for (std::size_t c = 0; c < 4; ++c) {
        const ElementVertexId a = mesh.corners[e][c], b = mesh.corners[e][(c + 1) % 4];
        if (is_end[index(a)] == 0 || is_end[index(b)] == 0)
          continue;
        if (const auto edge = element_at_.find(key_of(a, b)); edge != element_at_.end())
          edge->second = static_cast<ElementId>(e);
      }
  }

  /// Calls `use(larger)` for those beside an element.
  template <typename Use>
  void for_each(ElementId element, const Use& use) const {
    const ElementCorners& corners = mesh_.corners[index(element)];
    for (std::size_t c = 0; c < 4; ++c)
      for (const auto& [from, to] : {std::pair(c, (c + 1) % 4), std::pair((c + 1) % 4, c)}) {
        const std::uint32_t edge = edge_of_[index(corners[from])];
        if (edge == none_hangs)
          continue;
        const HangingVertex& h = mesh_.hanging[edge];
        if (corners[to] == h.end_a || corners[to] == h.end_b)
          if (const ElementId larger = element_at_.at(key_of(h.end_a, h.end_b));
              larger != none<ElementId>)
            use(larger);
      }
  }

private:
  static constexpr std::uint32_t none_hangs = std::numeric_limits<std::uint32_t>::max();
  static std::uint64_t key_of(ElementVertexId a, ElementVertexId b) {
    return std::uint64_t{std::min(index(a), index(b))} << 32U | std::max(index(a), index(b));
  }

  const ElementMesh& mesh_;
  std::vector<std::uint32_t> edge_of_; ///< by ElementVertexId: in `mesh.hanging`
  std::unordered_map<std::uint64_t, ElementId> element_at_;
};

/// The marked elements that may be divided, and those that have to be for their sake, as far as
/// hanging vertices tell: where one of the smaller elements beside such a vertex is divided, its
/// parts would be two levels below the element on whose edge it hangs.
std::vector<std::uint8_t> with_followers(const ElementMesh& mesh, const SurfaceModel& surfaces,
                                         std::span<const std::uint8_t> marked) {
  std::vector<std::uint8_t> divided(marked.begin(), marked.end());
  std::vector<ElementId> next;
  const auto mark = [&](std::size_t e) {
    divided[e] = is_divisible(mesh, surfaces, cell_of(mesh, static_cast<ElementId>(e))) ? 1 : 0;
    if (divided[e] != 0)
      next.push_back(static_cast<ElementId>(e));
  };
  for (std::size_t e = 0; e < marked.size(); ++e)
    if (marked[e] != 0)
      mark(e);
  if (mesh.hanging.empty())
    return divided;
  const LargerNeighbours larger(mesh);
  while (!next.empty()) {
    const ElementId element = next.back();
    next.pop_back();
    larger.for_each(element, [&](ElementId neighbour) {
      if (divided[index(neighbour)] == 0)
        mark(index(neighbour));
    });
  }
  return divided;
}

/// The roots with every cell divided that `is_divided(its number)` names,
/// before its children are asked about.
template <typename Predicate>
ElementMesh grown(const ElementMesh& mesh, Predicate&& is_divided) {
  ElementMesh result = roots_of(mesh);
  for (std::uint32_t cell = 0; cell < result.cells.size(); ++cell)
    if (is_divided(cell))
      divide_cell(result, cell);
  return result;
}

/// The cells of the mesh with these elements divided, and no elements yet,
/// and by cell the same of the mesh before, none for what is new.
std::pair<ElementMesh, std::vector<CellId>> with_divided(const ElementMesh& mesh,
                                                         std::span<const std::uint8_t> divided) {
  std::vector<CellId> was;
  for (const MeshSide& side : mesh.sides)
    for (std::uint32_t k = 0; k < side.root_count; ++k)
      was.push_back(static_cast<CellId>(side.first_cell + k));
  ElementMesh cells = grown(mesh, [&](std::uint32_t number) {
    if (was[number] == none<CellId>)
      return false;
    const MeshCell& before = mesh.cells[index(was[number])];
    if (is_leaf(before)) {
      const auto first = divided.begin() + before.first_element;
      if (std::find(first, first + before.element_count, 1) == first + before.element_count)
        return false;
      was.insert(was.end(), 4, none<CellId>);
      return true;
    }
    for (std::uint32_t k = 0; k < 4; ++k)
      was.push_back(static_cast<CellId>(index(before.first_child) + k));
    return true;
  });
  return {std::move(cells), std::move(was)};
}

} // namespace

ElementMesh divide_elements(const ElementMesh& mesh, const SurfaceModel& surfaces,
                            std::span<const std::uint8_t> marked) {
  std::vector<std::uint8_t> more(marked.begin(), marked.end());
  ElementMesh divided;
  for (const ElementMesh* before = &mesh;; before = &divided) {
    auto [result, was] = with_divided(*before, with_followers(*before, surfaces, more));
    const MeshBefore known{*before, was};
    const VertexNumbers vertices = add_elements(result, surfaces, &known);
    const PlacedVertices placed{result, surfaces, vertices};
    const std::vector<std::uint8_t> of_parts = corners_of_parts(result);
    result.hanging = hanging_vertices(placed, of_parts);
    more = to_follow(placed, of_parts);
    divided = std::move(result);
    if (more.empty())
      return divided;
  }
}

std::vector<std::uint8_t> division_of(const ElementMesh& mesh) {
  std::vector<std::uint8_t> division;
  division.reserve(mesh.cells.size());
  for (const MeshCell& cell : mesh.cells)
    division.push_back(is_leaf(cell) ? 0 : 1);
  return division;
}

bool is_division_of(const ElementMesh& roots, std::span<const std::uint8_t> division) {
  const std::size_t first = roots_of(roots).cells.size();
  std::vector<std::uint8_t> levels(first, 0);
  for (std::size_t cell = 0; cell < division.size(); ++cell) {
    if (cell >= levels.size() || division[cell] > 1 ||
        (division[cell] == 1 && levels[cell] >= max_levels))
      return false;
    if (division[cell] == 1)
      levels.insert(levels.end(), 4, static_cast<std::uint8_t>(levels[cell] + 1));
  }
  return levels.size() == division.size();
}

ElementMesh divided_mesh(const ElementMesh& roots, const SurfaceModel& surfaces,
                         std::span<const std::uint8_t> division) {
  ElementMesh result = grown(roots, [&](std::uint32_t cell) { return division[cell] != 0; });
  const VertexNumbers vertices = add_elements(result, surfaces);
  result.hanging = hanging_vertices({result, surfaces, vertices}, corners_of_parts(result));
  return result;
}

} // namespace meninas
