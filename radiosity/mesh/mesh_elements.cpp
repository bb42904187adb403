#include "radiosity/mesh/mesh_elements.h"

#include "radiosity/mesh/cut_cells.h"
#include "radiosity/mesh/mesh_cells.h"

#include <algorithm>
#include <span>

namespace meninas {

namespace {

double area_of(std::span<const Point3> polygon) {
  Vec3 sum(0.0);
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += glm::cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * glm::length(sum);
}

std::array<Vec2, 4> corner_coordinates(bool triangle) {
  if (triangle)
    return {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, 1.0)};
  return {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0), Vec2(0.0, 1.0)};
}

/// Elements as they are added.
struct NewElements {
  ElementMesh& mesh;
  const SurfaceModel& surfaces;
  const MeshBefore* before;
  VertexNumbers& vertices;
  const CutCells& cuts;
  const std::vector<std::uint8_t>& changed; ///< by surface_side(); empty: all are

  /// The leaf that this one is all the same as, on a side of a surface where no cell has been divided; null on
  /// others.
  const MeshCell* kept(const MeshCell& cell, std::uint32_t number) const {
    return changed.empty() || changed[surface_side(mesh, surfaces, cell)] != 0
               ? nullptr
               : &before->mesh.cells[index(before->cells[number])];
  }
  /// The cut of a leaf; null where nothing touches it.
  const CutCell* cut(std::uint32_t number) const {
    return cuts.of_cell.empty() || cuts.of_cell[number] == uncut
               ? nullptr
               : &cuts.cells[cuts.of_cell[number]];
  }
};

/// The corners of a leaf, which is what it was before.
ElementCorners corners_before(const NewElements& to, const MeshCell& was) {
  const ElementMesh& before = to.before->mesh;
  ElementCorners corners = before.corners[was.first_element];
  for (ElementVertexId& corner : corners)
    corner = to.vertices.number_of(corner, before.vertices[index(corner)], to.mesh.vertices);
  return corners;
}

/// Whether a leaf is all of its side and its surface.
bool is_alone(const NewElements& to, const MeshCell& cell) {
  const MeshSide& side = to.mesh.sides[index(cell.side)];
  const SurfaceId surface = to.surfaces.patches[index(side.patch)].surface;
  return cell.level == 0 && side.root_count == 1 &&
         to.surfaces.surfaces[index(surface)].patches.size() == 1;
}

/// The corners of a leaf by their places, and its area.
ElementCorners new_corners(const NewElements& to, MeshCell& cell) {
  const bool triangle = to.mesh.sides[index(cell.side)].triangle;
  const auto coordinates = corner_coordinates(triangle);
  std::array<Point3, 4> points;
  for (std::size_t c = 0; c < 4; ++c)
    points[c] = point_in(to.mesh, to.surfaces, cell, coordinates[c]);
  const std::span<const Point3> polygon = std::span(points).first(triangle ? 3 : 4);
  cell.area = area_of(polygon);
  ElementCorners corners;
  if (is_alone(to, cell)) {
    corners = to.vertices.vertices_apart(polygon, to.mesh.vertices);
  } else {
    const std::uint64_t side = surface_side(to.mesh, to.surfaces, cell);
    for (std::size_t c = 0; c < polygon.size(); ++c)
      corners[c] = to.vertices.vertex_at(side, polygon[c], to.mesh.vertices);
  }
  if (triangle)
    corners[3] = corners[2];
  return corners;
}

/// The corners of a region of a cut leaf. Corners it does not share are told apart by their group.
ElementCorners corners_of_region(const NewElements& to, const MeshCell& cell,
                                 const CutRegion& region) {
  constexpr std::uint64_t group_bits = 34; // above the numbers of sides of surfaces
  const bool triangle = to.mesh.sides[index(cell.side)].triangle;
  const auto coordinates = corner_coordinates(triangle);
  const std::uint64_t side = surface_side(to.mesh, to.surfaces, cell);
  ElementCorners corners;
  for (std::size_t c = 0; c < 4; ++c) {
    if (c == 3 && triangle) {
      corners[c] = corners[2];
      continue;
    }
    const std::uint32_t group = region.corners[c].group;
    const bool shared = group == RegionCorner::shared;
    corners[c] = to.vertices.vertex_at(shared ? side : side | (group + 1ULL) << group_bits,
                                       point_in(to.mesh, to.surfaces, cell, coordinates[c]),
                                       to.mesh.vertices);
    to.mesh.at_contact.resize(to.mesh.vertices.size(), 0);
    to.mesh.at_contact[index(corners[c])] = shared ? 0 : 1;
  }
  return corners;
}

void append_element(ElementMesh& mesh, CellId cell, const ElementCorners& corners, double area) {
  const MeshSide& side = mesh.sides[index(mesh.cells[index(cell)].side)];
  mesh.cell_of_element.push_back(cell);
  mesh.side_of_element.push_back(mesh.cells[index(cell)].side);
  mesh.corners.push_back(corners);
  mesh.area.push_back(area);
  mesh.reflectance.push_back(side.reflectance);
  mesh.emission.push_back(side.emission);
  mesh.solid.push_back(1.0F);
}

/// A leaf has these lines, counted from `first` there.
void append_lines(ElementMesh& mesh, std::uint32_t number, std::span<const CellLine> lines,
                  std::uint32_t first) {
  const auto begin = static_cast<std::uint32_t>(mesh.lines.size());
  mesh.line_of_cell.resize(mesh.cells.size(), uncut);
  mesh.line_of_cell[number] = begin;
  for (CellLine line : lines) {
    for (std::uint32_t& next : line.next)
      next = (next & CellLine::region) != 0 ? next : next - first + begin;
    mesh.lines.push_back(line);
  }
}

/// The last element is a region of a cut leaf.
void append_region(ElementMesh& mesh, const RegionElement& region) {
  mesh.region_of_element.resize(mesh.area.size(), uncut);
  mesh.region_of_element.back() = static_cast<std::uint32_t>(mesh.regions.size());
  mesh.regions.push_back(region);
}

void set_walled_edges(ElementMesh& mesh, std::uint32_t number, std::uint8_t walled) {
  if (walled == 0)
    return;
  mesh.walled_edges.resize(mesh.cells.size(), 0);
  mesh.walled_edges[number] = walled;
}

/// The lines of a leaf, which are in a row from `first` on.
std::span<const CellLine> lines_from(const ElementMesh& mesh, std::uint32_t first) {
  std::uint32_t end = first + 1;
  for (std::uint32_t line = first; line < end; ++line)
    for (const std::uint32_t next : mesh.lines[line].next)
      if ((next & CellLine::region) == 0)
        end = std::max(end, next + 1);
  return std::span(mesh.lines).subspan(first, end - first);
}

/// One element for every region of a leaf that something touches.
void add_regions(const NewElements& to, std::uint32_t number, const CutCell& cut) {
  ElementMesh& mesh = to.mesh;
  MeshCell& cell = mesh.cells[number];
  cell.first_element = static_cast<std::uint32_t>(mesh.area.size());
  cell.element_count = static_cast<std::uint32_t>(cut.regions.size());
  set_walled_edges(mesh, number, cut.walled_edges);
  cell.area = 0.0;
  for (const CutRegion& region : cut.regions)
    cell.area += region.element.area_up_to.empty() ? 0.0 : region.element.area_up_to.back();
  for (const CutRegion& region : cut.regions) {
    const double area =
        region.element.area_up_to.empty() ? 0.0 : region.element.area_up_to.back();
    append_element(mesh, static_cast<CellId>(number), corners_of_region(to, cell, region), area);
    if (!cut.lines.empty())
      append_region(mesh, region.element);
  }
  if (!cut.lines.empty())
    append_lines(mesh, number, cut.lines, 0);
}

/// The elements of a leaf as they were, with what something that stands there has made of them.
void keep_elements(const NewElements& to, std::uint32_t number, const MeshCell& was) {
  ElementMesh& mesh = to.mesh;
  const ElementMesh& before = to.before->mesh;
  const std::uint32_t of_before = index(to.before->cells[number]);
  MeshCell& cell = mesh.cells[number];
  cell.first_element = static_cast<std::uint32_t>(mesh.area.size());
  cell.element_count = was.element_count;
  cell.area = was.area;
  if (!before.walled_edges.empty())
    set_walled_edges(mesh, number, before.walled_edges[of_before]);
  for (std::uint32_t e = was.first_element; e < was.first_element + was.element_count; ++e) {
    ElementCorners corners = before.corners[e];
    for (ElementVertexId& corner : corners) {
      const std::size_t vertex = index(corner);
      corner = to.vertices.number_of(corner, before.vertices[vertex], mesh.vertices);
      if (!is_at_contact(before, vertex))
        continue;
      mesh.at_contact.resize(mesh.vertices.size(), 0);
      mesh.at_contact[index(corner)] = 1;
    }
    append_element(mesh, static_cast<CellId>(number), corners, before.area[e]);
    if (const RegionElement* region = region_of(before, ElementId{e}))
      append_region(mesh, *region);
  }
  if (!before.line_of_cell.empty() && before.line_of_cell[of_before] != uncut) {
    const std::uint32_t first = before.line_of_cell[of_before];
    append_lines(mesh, number, lines_from(before, first), first);
  }
}

void add_element(const NewElements& to, std::uint32_t number) {
  ElementMesh& mesh = to.mesh;
  if (const MeshCell* was = to.kept(mesh.cells[number], number)) {
    keep_elements(to, number, *was);
    return;
  }
  if (const CutCell* cut = to.cut(number)) {
    add_regions(to, number, *cut);
    return;
  }
  MeshCell& cell = mesh.cells[number];
  const CellId before = to.before ? to.before->cells[number] : none<CellId>;
  ElementCorners corners;
  if (before == none<CellId>) {
    corners = new_corners(to, cell);
  } else {
    const MeshCell& was = to.before->mesh.cells[index(before)];
    corners = corners_before(to, was);
    cell.area = was.area;
  }
  cell.first_element = static_cast<std::uint32_t>(mesh.area.size());
  cell.element_count = 1;
  append_element(mesh, static_cast<CellId>(number), corners, cell.area);
}

/// The leaves below a cell, depth first.
void add_leaves(const NewElements& to, std::uint32_t number) {
  ElementMesh& mesh = to.mesh;
  if (is_leaf(mesh.cells[number])) {
    add_element(to, number);
    return;
  }
  const auto first = static_cast<std::uint32_t>(mesh.area.size());
  const std::uint32_t child = index(mesh.cells[number].first_child);
  double area = 0.0;
  for (std::uint32_t k = 0; k < 4; ++k) {
    add_leaves(to, child + k);
    area += mesh.cells[child + k].area;
  }
  MeshCell& cell = mesh.cells[number];
  cell.area = area;
  cell.first_element = first;
  cell.element_count = static_cast<std::uint32_t>(mesh.area.size()) - first;
}

/// By surface_side(): 1 where any cell is new; empty where all are.
std::vector<std::uint8_t> changed_sides(const ElementMesh& mesh, const SurfaceModel& surfaces,
                                        const MeshBefore* before) {
  std::vector<std::uint8_t> changed(before ? 2 * surfaces.surfaces.size() : 0, 0);
  for (std::size_t number = 0; !changed.empty() && number < mesh.cells.size(); ++number)
    if (before->cells[number] == none<CellId>)
      changed[surface_side(mesh, surfaces, mesh.cells[number])] = 1;
  return changed;
}

/// By surface_side(): 1 where elements are new, or parts of divided cells. On other surfaces nobody asks
/// for a vertex by its place.
std::vector<std::uint8_t> surfaces_with_parts(const ElementMesh& mesh, const SurfaceModel& surfaces,
                                              const CutCells& cuts) {
  std::vector<std::uint8_t> have(2 * surfaces.surfaces.size(), 0);
  for (std::size_t number = 0; number < mesh.cells.size(); ++number) {
    const MeshCell& cell = mesh.cells[number];
    const bool touched = !cuts.of_cell.empty() && cuts.of_cell[number] != uncut;
    if (touched || cell.level > 0)
      have[surface_side(mesh, surfaces, cell)] = 1;
  }
  return have;
}

/// The vertices before that new elements may share, by place: corners of cells that are divided,
/// and of the parts of others. Within a patch roots beside one another are alike.
/// Leaves that something touches are made anew.
void place_vertices(const ElementMesh& mesh, const SurfaceModel& surfaces, const MeshBefore& before,
                    const CutCells& cuts, VertexNumbers& vertices) {
  const std::vector<std::uint8_t> has_parts = surfaces_with_parts(mesh, surfaces, cuts);
  for (std::size_t number = 0; number < mesh.cells.size(); ++number) {
    if (before.cells[number] == none<CellId> ||
        has_parts[surface_side(mesh, surfaces, mesh.cells[number])] == 0)
      continue;
    const MeshCell& was = before.mesh.cells[index(before.cells[number])];
    const bool touched = !cuts.of_cell.empty() && cuts.of_cell[number] != uncut;
    if (!is_leaf(was) || (was.level == 0 && is_leaf(mesh.cells[number]) && !touched &&
                          !is_at_border(before.mesh, was)))
      continue;
    const std::uint64_t side = surface_side(before.mesh, surfaces, was);
    for (std::uint32_t e = was.first_element; e < was.first_element + was.element_count; ++e)
      for (const ElementVertexId corner : before.mesh.corners[e])
        if (!is_at_contact(before.mesh, index(corner)))
          vertices.place(side, before.mesh.vertices[index(corner)], corner);
  }
}

} // namespace

/// tau_d by element, where any side is a translucent surface.
static void set_transmittance(ElementMesh& mesh) {
  mesh.transmittance.clear();
  if (std::ranges::all_of(mesh.sides,
                          [](const MeshSide& side) { return side.transmittance == Rgb(0.0); }))
    return;
  for (const MeshSide& side : mesh.sides)
    mesh.transmittance.insert(mesh.transmittance.end(), side.element_count, side.transmittance);
}

VertexNumbers add_elements(ElementMesh& mesh, const SurfaceModel& surfaces,
                           const MeshBefore* before) {
  const std::size_t vertices_before = before ? before->mesh.vertices.size() : 0;
  VertexNumbers vertices(vertex_grain(mesh, surfaces), vertices_before);
  const std::vector<std::uint8_t> changed = changed_sides(mesh, surfaces, before);
  const CutCells cuts = cut_leaves(mesh, surfaces, changed);
  if (before)
    place_vertices(mesh, surfaces, *before, cuts, vertices);
  const NewElements to{mesh, surfaces, before, vertices, cuts, changed};
  for (MeshSide& side : mesh.sides) {
    side.first_element = static_cast<std::uint32_t>(mesh.area.size());
    for (std::uint32_t k = 0; k < side.root_count; ++k)
      add_leaves(to, side.first_cell + k);
    side.element_count = static_cast<std::uint32_t>(mesh.area.size()) - side.first_element;
  }
  set_transmittance(mesh);
  if (!mesh.line_of_cell.empty()) {
    mesh.line_of_cell.resize(mesh.cells.size(), uncut);
    mesh.region_of_element.resize(mesh.area.size(), uncut);
  }
  if (!mesh.at_contact.empty())
    mesh.at_contact.resize(mesh.vertices.size(), 0);
  mesh.element_of_vertex.assign(mesh.vertices.size(), none<ElementId>);
  for (std::size_t e = mesh.corners.size(); e-- > 0;)
    for (const auto vertex : mesh.corners[e])
      mesh.element_of_vertex[index(vertex)] = static_cast<ElementId>(e);
  return vertices;
}

} // namespace meninas
