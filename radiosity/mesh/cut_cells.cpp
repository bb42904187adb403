#include "radiosity/mesh/cut_cells.h"

#include "radiosity/mesh/contact_segments.h"
#include "radiosity/mesh/mesh_cells.h"
#include "scenes/surfaces/disjoint_sets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace meninas {

namespace {

constexpr double min_reach = 0.25;   ///< of a leaf, of the runs that cut it
constexpr double min_region = 0.25;  ///< of the edge of an element of the size asked for
constexpr double always_regions = 4; ///< so many has a leaf in which two walls cross

struct CellInRoot {
  std::uint32_t number = 0, root = 0; ///< cells
};

/// A leaf in the plane of its side.
struct PlaneCell {
  std::vector<Vec2> corners, outline; ///< by number, and counter-clockwise
  std::vector<Segment2> segments;
  double size = 0.0, grain = 0.0;
  double step = 0.0; ///< the same for all leaves of the surface

  std::size_t next(std::size_t c) const { return (c + 1) % corners.size(); }
};

/// With the runs that are at least `reach` times as long as the leaf is wide.
PlaneCell plane_cell(const ElementMesh& mesh, const SurfaceModel& surfaces, const CellInRoot& in,
                     const PlanePlace& place, double reach) {
  const MeshCell& cell = mesh.cells[in.number];
  constexpr std::array<Vec2, 4> quad{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  constexpr std::array<Vec2, 3> triangle{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  const MeshSide& side = mesh.sides[index(cell.side)];
  PlaneCell result;
  for (const Vec2 st : side.triangle ? std::span<const Vec2>(triangle) : std::span<const Vec2>(quad))
    result.corners.push_back(place(point_in(mesh, surfaces, cell, st)));
  result.outline = result.corners;
  if (area_of(result.outline) < 0.0)
    std::ranges::reverse(result.outline);
  result.size = std::sqrt(area_of(result.outline));
  const SurfaceId surface = surfaces.patches[index(side.patch)].surface;
  result.grain = 2e-4 * result.size + 8.0 * surfaces.surfaces[index(surface)].tolerance;
  result.step = 0.1 * mesh.element_size;
  const ContactSegments& contacts = *mesh.contacts;
  for (std::uint32_t k = contacts.begin[in.root]; k < contacts.begin[in.root + 1]; ++k) {
    const ContactSegment& segment = contacts.segments[contacts.in_cell[k]];
    Segment2 inside = segment.at;
    if (segment.reach >= reach * result.size && clip_to(result.outline, result.grain, inside))
      result.segments.push_back(segment.at);
  }
  return result;
}

/// The open stretches of an edge of a leaf, between the places where something stands on it.
struct OpenEdge {
  bool met = false; ///< something stands on it, its ends included
  bool met_at_start = false, met_at_end = false;
  bool walled = false; ///< along some of it
  std::vector<Stretch> open;
};
OpenEdge open_edge(const PlaneCell& cell, std::size_t k) {
  const Vec2 a = cell.corners[k], b = cell.corners[cell.next(k)];
  const double length = glm::distance(a, b), near = 2.0 * cell.grain / length;
  OpenEdge edge;
  double from = 0.0;
  for (const Stretch& stretch : met_along(a, b, cell.segments, cell.grain)) {
    edge.met = true;
    edge.met_at_start = edge.met_at_start || stretch.from <= near;
    edge.met_at_end = edge.met_at_end || stretch.to >= 1.0 - near;
    edge.walled = edge.walled || stretch.to - stretch.from > 4.0 * near;
    if (stretch.from - from > near)
      edge.open.push_back({from, stretch.from});
    from = stretch.to;
  }
  if (1.0 - from > near)
    edge.open.push_back({from, 1.0});
  return edge;
}

bool overlap(const Stretch& a, const Stretch& b, double by) {
  return std::min(a.to, b.to) - std::max(a.from, b.from) > by;
}

/// Names for vertices: of those that are the same all are joined.
class VertexGroups {
public:
  explicit VertexGroups(double grain) : welder_(grain) {}

  /// The vertex at a corner that all share which have it for their own.
  std::uint32_t shared(std::uint64_t surface_side, const Point3& corner) {
    return named({place(surface_side, corner), all});
  }
  /// That of those who know it by the same landmark.
  std::uint32_t beside(std::uint64_t surface_side, const Point3& corner, const Point3& landmark) {
    return named({place(surface_side, corner), place(surface_side, landmark)});
  }
  void join(std::uint32_t a, std::uint32_t b) { joined_.emplace_back(a, b); }

  /// By name: the group, or RegionCorner::shared. No more names after this.
  std::vector<std::uint32_t> groups() const {
    DisjointSets sets(names_.size());
    for (const auto& [a, b] : joined_)
      sets.join(a, b);
    std::vector<std::uint32_t> result(names_.size());
    std::vector<std::uint8_t> is_shared(names_.size(), 0);
    for (const auto& [name, number] : names_)
      if (name.second == all)
        is_shared[sets.root(number)] = 1;
    for (std::uint32_t n = 0; n < result.size(); ++n)
      result[n] = is_shared[sets.root(n)] != 0 ? RegionCorner::shared : sets.root(n);
    return result;
  }

private:
  static constexpr std::uint32_t all = 0xffffffffU;
  using Name = std::pair<std::uint32_t, std::uint32_t>;

  std::uint32_t place(std::uint64_t surface_side, const Point3& x) {
    return index(welder_.vertex_at(surface_side, x, places_));
  }
  std::uint32_t named(const Name& name) {
    return names_.try_emplace(name, static_cast<std::uint32_t>(names_.size())).first->second;
  }

  VertexWelder welder_;
  std::vector<Point3> places_;
  std::map<Name, std::uint32_t> names_;
  std::vector<Name> joined_;
};

/// The landmark that tells an open stretch of edge k from others, at its end c, in leaves of any size beside it:
/// the place nearest to the corner where something stands, or the way that leads from the corner.
Vec2 landmark(const PlaneCell& cell, std::size_t k, std::size_t corner, const Stretch& stretch) {
  const Vec2 a = cell.corners[k], b = cell.corners[cell.next(k)];
  const double near = 2.0 * cell.grain / glm::distance(a, b);
  const bool at_start = k == corner;
  if (at_start ? stretch.from <= near : stretch.to >= 1.0 - near)
    return cell.corners[corner] +
           cell.step * glm::normalize(at_start ? b - a : a - b);
  return glm::mix(a, b, at_start ? stretch.from : stretch.to);
}

/// One region of a cut leaf.
struct RegionOfCut {
  const CutPolygon& cut;
  std::uint32_t region;
  const PlanePlace& place; ///< of the leaf's plane in space
};

/// Names the corners of a region.
void name_corners(const PlaneCell& cell, const RegionOfCut& of, std::uint64_t surface_side,
                  std::span<const OpenEdge> edges, VertexGroups& groups, CutRegion& result) {
  const CutPolygon& cut = of.cut;
  const PlanePlace& place = of.place;
  const std::uint32_t region = of.region;
  const std::size_t count = cell.corners.size();
  for (std::size_t c = 0; c < count; ++c) {
    const Point3 corner = place.at(cell.corners[c]);
    const std::size_t before = (c + count - 1) % count;
    const bool own = has_corner(cut, region, cell.corners[c], cell.grain);
    const bool at_contact = edges[c].met_at_start || edges[before].met_at_end;
    std::vector<std::uint32_t> names;
    if (own && !at_contact)
      names.push_back(groups.shared(surface_side, corner));
    for (const std::size_t k : {c, before}) {
      const std::vector<Stretch> here =
          stretches_along(cell.corners[k], cell.corners[cell.next(k)], cut, region, cell.grain);
      if (here.empty())
        continue;
      if (!edges[k].met) {
        names.push_back(groups.shared(surface_side, corner));
        continue;
      }
      // The open stretch next to the corner on which the region lies.
      const Stretch* nearest = nullptr;
      for (const Stretch& open : edges[k].open) {
        const bool lies_there = std::ranges::any_of(here, [&](const Stretch& stretch) {
          return overlap(open, stretch, 1e-3);
        });
        if (lies_there && (nearest == nullptr || k == before))
          nearest = &open;
      }
      if (nearest != nullptr)
        names.push_back(
            groups.beside(surface_side, corner, place.at(landmark(cell, k, c, *nearest))));
    }
    if (names.empty())
      names.push_back(groups.beside(surface_side, corner, result.element.centroid));
    for (const std::uint32_t name : names)
      groups.join(names.front(), name);
    result.corners[c].group = names.front();
    if (own)
      result.element.own_corners |= static_cast<std::uint8_t>(1U << c);
  }
}

/// The region's area, its middle, and what a bilinear value is there.
void measure(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshCell& cell,
             const RegionOfCut& of, RegionElement& element) {
  const auto& [cut, region, place] = of;
  double area = 0.0;
  Point3 moment(0.0);
  for (std::size_t p = 0; p < cut.pieces.size(); ++p) {
    if (cut.region[p] != region)
      continue;
    const auto& points = cut.pieces[p];
    for (std::size_t k = 2; k < points.size(); ++k) {
      const std::array<Vec2, 3> flat{points[0], points[k - 1], points[k]};
      const std::array<Point3, 3> triangle{place.at(flat[0]), place.at(flat[1]), place.at(flat[2])};
      const double own = area_of(flat);
      if (!(own > 0.0))
        continue;
      area += own;
      moment += own / 3.0 * (triangle[0] + triangle[1] + triangle[2]);
      element.triangles.push_back(triangle);
      element.area_up_to.push_back(area);
    }
  }
  element.centroid = area > 0.0 ? moment / area : place.at(cut.pieces[0][0]);
  const MeshSide& side = mesh.sides[index(cell.side)];
  const Vec2 uv = uv_at(surfaces.patches[index(side.patch)], element.centroid);
  const double sign = cell.flipped ? -1.0 : 1.0;
  const Vec2 st = glm::clamp(sign * (uv * Vec2(side.nu << cell.level, side.nv << cell.level) -
                                     Vec2(cell.i, cell.j)),
                             0.0, 1.0);
  if (side.triangle)
    element.corner_weights = {1.0 - st.x - st.y, st.x, st.y, 0.0};
  else
    element.corner_weights = {(1.0 - st.x) * (1.0 - st.y), st.x * (1.0 - st.y), st.x * st.y,
                              (1.0 - st.x) * st.y};
}

/// The line in the leaf's own (s, t), by what it is at the corners.
CellLine cell_line(const PlaneCell& cell, const CutLine& line) {
  const auto at = [&](std::size_t c) {
    return glm::dot(line.normal, cell.corners[c]) - line.offset;
  };
  if (cell.corners.size() == 3)
    return {{at(0), at(1) - at(0), at(2) - at(0), 0.0}, {}};
  return {{at(0), at(1) - at(0), at(3) - at(0), at(2) - at(1) - at(3) + at(0)}, {}};
}

/// The lines of a leaf that is cut, counted from 0.
std::vector<CellLine> lines_of(const PlaneCell& cell, const CutPolygon& cut) {
  std::vector<CellLine> lines;
  for (const CutLine& line : cut.lines) {
    CellLine here = cell_line(cell, line);
    for (std::size_t k = 0; k < 2; ++k)
      here.next[k] = (line.next[k] & CutLine::piece) != 0
                         ? CellLine::region | cut.region[line.next[k] & ~CutLine::piece]
                         : line.next[k];
    lines.push_back(here);
  }
  return lines;
}

/// The leaves of a mesh with the roots they are in.
template <typename Use>
void for_each_leaf(const ElementMesh& mesh, std::uint32_t number, std::uint32_t root,
                   const Use& use) {
  const MeshCell& cell = mesh.cells[number];
  if (is_leaf(cell)) {
    use(number, root);
    return;
  }
  for (std::uint32_t k = 0; k < 4; ++k)
    for_each_leaf(mesh, index(cell.first_child) + k, root, use);
}

struct CutLeaf {
  CellInRoot in;
  CutCell cell;
};

/// Regions that are as large as light needs: many small things that stand together would make many times more.
double max_regions(const PlaneCell& flat, const MeshSide& side) {
  const double in_regions = flat.size / (min_region * side.element_size);
  return std::max(always_regions, in_regions * in_regions);
}

/// Appends the leaf, unless nothing touches it.
void cut_leaf(const ElementMesh& mesh, const SurfaceModel& surfaces, const CellInRoot& in,
              VertexGroups& groups, std::vector<CutLeaf>& leaves) {
  const MeshCell& cell = mesh.cells[in.number];
  const MeshSide& side = mesh.sides[index(cell.side)];
  const PlanePlace place(surfaces.patches[index(side.patch)], side);
  PlaneCell flat = plane_cell(mesh, surfaces, in, place, min_reach);
  CutPolygon cut = cut_polygon(flat.outline, flat.segments, flat.grain);
  for (double reach = 2.0 * min_reach; cut.regions > max_regions(flat, side); reach *= 2.0) {
    flat = plane_cell(mesh, surfaces, in, place, reach);
    cut = cut_polygon(flat.outline, flat.segments, flat.grain);
  }
  if (flat.segments.empty())
    return;
  std::vector<OpenEdge> edges;
  for (std::size_t k = 0; k < flat.corners.size(); ++k)
    edges.push_back(open_edge(flat, k));
  CutLeaf leaf{in, {}};
  for (std::size_t k = 0; k < edges.size(); ++k)
    if (edges[k].walled)
      leaf.cell.walled_edges |= static_cast<std::uint8_t>(1U << k);
  if (cut.regions > 1)
    leaf.cell.lines = lines_of(flat, cut);
  for (std::uint32_t region = 0; region < cut.regions; ++region) {
    CutRegion& added = leaf.cell.regions.emplace_back();
    const RegionOfCut of{cut, region, place};
    measure(mesh, surfaces, cell, of, added.element);
    name_corners(flat, of, surface_side(mesh, surfaces, cell), edges, groups, added);
  }
  leaves.push_back(std::move(leaf));
}

/// Roots on which something stands, those of one side of a surface in a row:
/// they alone share vertices.
struct RootsBySide {
  std::vector<std::uint32_t> roots;
  std::vector<std::size_t> begin; ///< by side of a surface, and the end
};
RootsBySide roots_by_side(const ElementMesh& mesh, const SurfaceModel& surfaces,
                          std::span<const std::uint8_t> wanted) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
  for (std::uint32_t root = 0; root + 1 < mesh.contacts->begin.size(); ++root)
    if (mesh.contacts->begin[root] != mesh.contacts->begin[root + 1])
      sorted.emplace_back(surface_side(mesh, surfaces, mesh.cells[root]), root);
  if (!wanted.empty())
    std::erase_if(sorted, [&](const auto& root) { return wanted[root.first] == 0; });
  std::ranges::sort(sorted);
  RootsBySide by_side;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k == 0 || sorted[k].first != sorted[k - 1].first)
      by_side.begin.push_back(k);
    by_side.roots.push_back(sorted[k].second);
  }
  by_side.begin.push_back(sorted.size());
  return by_side;
}

/// The cut leaves of one side of a surface; their corners get their groups.
std::vector<CutLeaf> cut_leaves_of(const ElementMesh& mesh, const SurfaceModel& surfaces,
                                   std::span<const std::uint32_t> roots) {
  std::vector<CutLeaf> leaves;
  VertexGroups groups(vertex_grain(mesh, surfaces));
  for (const std::uint32_t root : roots)
    for_each_leaf(mesh, root, root, [&](std::uint32_t number, std::uint32_t of) {
      cut_leaf(mesh, surfaces, {number, of}, groups, leaves);
    });
  const std::vector<std::uint32_t> group = groups.groups();
  for (CutLeaf& leaf : leaves)
    for (CutRegion& region : leaf.cell.regions)
      for (RegionCorner& corner : region.corners)
        if (corner.group != RegionCorner::shared)
          corner.group = group[corner.group];
  return leaves;
}

void append(CutLeaf& leaf, CutCells& cuts) {
  cuts.of_cell[leaf.in.number] = static_cast<std::uint32_t>(cuts.cells.size());
  cuts.cells.push_back(std::move(leaf.cell));
}

} // namespace

CutCells cut_leaves(const ElementMesh& mesh, const SurfaceModel& surfaces,
                    std::span<const std::uint8_t> wanted) {
  CutCells cuts;
  if (!mesh.contacts || mesh.contacts->segments.empty())
    return cuts;
  cuts.of_cell.assign(mesh.cells.size(), uncut);
  const auto [roots, begin] = roots_by_side(mesh, surfaces, wanted);
  std::vector<std::vector<CutLeaf>> of_side(begin.size() - 1);
  tbb::parallel_for(std::size_t{0}, of_side.size(), [&](std::size_t s) {
    of_side[s] = cut_leaves_of(mesh, surfaces,
                               std::span(roots).subspan(begin[s], begin[s + 1] - begin[s]));
  });
  std::vector<CutLeaf*> in_order;
  for (auto& leaves : of_side)
    for (CutLeaf& leaf : leaves)
      in_order.push_back(&leaf);
  std::ranges::stable_sort(in_order, {}, [](const CutLeaf* leaf) { return leaf->in.root; });
  for (CutLeaf* leaf : in_order)
    append(*leaf, cuts);
  return cuts;
}

} // namespace meninas
