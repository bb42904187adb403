#include "radiosity/field/view/lattice_cells.h"

#include "scenes/sampling.h"

#include <algorithm>

namespace meninas {

namespace {

/// Steps along s and t of corner k, in widths of the cell.
constexpr std::array<LatticePoint, 4> quad_steps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<LatticePoint, 3> triangle_steps{{{0, 0}, {1, 0}, {0, 1}}};

std::int64_t width_at(int level) { return std::int64_t{1} << (LatticeCells::finest - level); }

LatticePoint moved(LatticePoint from, LatticePoint steps, std::int64_t width) {
  return {from.x + steps.x * width, from.y + steps.y * width};
}

LatticePoint middle(LatticePoint a, LatticePoint b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

} // namespace

std::size_t LatticeCells::KeyHash::operator()(const Key& key) const {
  const auto low = [](std::int64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::int64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  return hash(hash(static_cast<std::uint32_t>(key.owner), low(key.x), low(key.y)),
              static_cast<std::uint32_t>(key.owner >> 32U), hash(high(key.x), high(key.y)));
}

LatticeCells::LatticeCells(const ElementMesh& mesh, std::span<const ElementId> elements)
    : mesh_(mesh) {
  cells_.reserve(elements.size());
  for (const ElementId element : elements) {
    const MeshCell& of = cell_of(mesh, element);
    const std::int64_t width = width_at(of.level);
    LatticeCell cell{.element = element,
                     .origin = {of.i * width, of.j * width},
                     .level = of.level,
                     .flipped = of.flipped};
    add_corners(cell);
    cells_.push_back(cell);
  }
  halve_edges_of_roots();
}

/// Corners of elements in the middle of a larger one's edge.
void LatticeCells::halve_edges_of_roots() {
  for (const LatticeCell& cell : cells_)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t a = cell.corners[c], b = cell.corners[(c + 1) % 4];
      const std::uint32_t middle = a == b ? no_vertex : middle_of(a, b);
      if (middle == no_vertex || (is_triangle(cell) && c == 3))
        continue;
      vertices_[middle].between = {a, b, a, b};
      vertices_[middle].level = static_cast<std::uint8_t>(cell.level + 1);
    }
}

bool LatticeCells::stands_apart(ElementId element) const {
  if (region_of(mesh_, element) != nullptr)
    return true;
  const std::size_t cell = index(mesh_.cell_of_element[index(element)]);
  return (!mesh_.walled_edges.empty() && mesh_.walled_edges[cell] != 0) ||
         std::ranges::any_of(mesh_.corners[index(element)],
                             [&](ElementVertexId v) { return is_at_contact(mesh_, index(v)); });
}

bool LatticeCells::is_triangle(const LatticeCell& cell) const {
  return mesh_.sides[index(mesh_.side_of_element[index(cell.element)])].triangle;
}

LatticeCells::Key LatticeCells::key_of(ElementId element, LatticePoint at) const {
  constexpr std::uint64_t is_element = std::uint64_t{1} << 32U;
  const std::uint64_t owner = stands_apart(element) ? is_element | index(element)
                                                    : index(mesh_.side_of_element[index(element)]);
  return {owner, at.x, at.y};
}

std::uint32_t LatticeCells::vertex_at(const LatticeCell& cell, LatticePoint at, std::uint8_t level,
                                      const std::array<std::uint32_t, 4>* between) {
  const auto number = static_cast<std::uint32_t>(vertices_.size());
  const auto [found, is_new] = numbers_.try_emplace(key_of(cell.element, at), number);
  if (is_new)
    vertices_.push_back(
        {cell.element, at, level, between ? *between : std::array{number, number, number, number}});
  return found->second;
}

void LatticeCells::add_corners(LatticeCell& cell) {
  const std::int64_t width = (cell.flipped ? -1 : 1) * width_at(cell.level);
  for (std::size_t c = 0; c < 4; ++c) {
    const bool repeats = c == 3 && is_triangle(cell);
    const LatticePoint steps = is_triangle(cell) ? triangle_steps[repeats ? 2 : c] : quad_steps[c];
    cell.corners[c] = vertex_at(cell, moved(cell.origin, steps, width), cell.level, nullptr);
  }
}

void LatticeCells::divide(std::uint32_t number) {
  const LatticeCell cell = cells_[number];
  const bool triangle = is_triangle(cell);
  const auto level = static_cast<std::uint8_t>(cell.level + 1);
  const std::size_t count = triangle ? 3 : 4;
  const auto at = [&](std::size_t c) { return vertices_[cell.corners[c % count]].at; };
  std::array<std::uint32_t, 4> edges{};
  for (std::size_t c = 0; c < count; ++c) {
    const std::uint32_t a = cell.corners[c], b = cell.corners[(c + 1) % count];
    const std::array between{a, b, a, b};
    edges[c] = vertex_at(cell, middle(at(c), at(c + 1)), level, &between);
  }
  const auto child = [&](LatticePoint origin, bool flipped, std::array<std::uint32_t, 4> corners) {
    cells_.push_back({cell.element, origin, level, flipped, corners});
  };
  const auto& c = cell.corners;
  cells_[number].first_child = static_cast<std::uint32_t>(cells_.size());
  if (triangle) {
    const auto [ab, bc, ca, unused] = edges;
    child(at(0), cell.flipped, {c[0], ab, ca, ca});
    child(vertices_[ab].at, cell.flipped, {ab, c[1], bc, bc});
    child(vertices_[ca].at, cell.flipped, {ca, bc, c[2], c[2]});
    child(vertices_[bc].at, !cell.flipped, {bc, ca, ab, ab});
    return;
  }
  const std::uint32_t centre = vertex_at(cell, middle(at(0), at(2)), level, &cell.corners);
  child(at(0), false, {c[0], edges[0], centre, edges[3]});
  child(vertices_[edges[0]].at, false, {edges[0], c[1], edges[1], centre});
  child(vertices_[edges[3]].at, false, {edges[3], centre, edges[2], c[3]});
  child(vertices_[centre].at, false, {centre, edges[1], c[2], edges[2]});
}

std::array<std::uint32_t, 4> LatticeCells::edge_middles(const LatticeCell& divided) const {
  const LatticeCell* children = &cells_[divided.first_child];
  if (is_triangle(divided))
    return {children[0].corners[1], children[1].corners[2], children[0].corners[2],
            LatticeCells::no_vertex};
  return {children[0].corners[1], children[1].corners[2], children[2].corners[2],
          children[0].corners[3]};
}

std::uint32_t LatticeCells::middle_of(std::uint32_t a, std::uint32_t b) const {
  const LatticeVertex &from = vertices_[a], &to = vertices_[b];
  const auto found = numbers_.find(key_of(from.element, middle(from.at, to.at)));
  return found == numbers_.end() ? no_vertex : found->second;
}

Vec2 LatticeCells::place_in_patch(const LatticeVertex& vertex) const {
  const MeshSide& side = mesh_.sides[index(mesh_.side_of_element[index(vertex.element)])];
  const auto root = static_cast<double>(width_at(0));
  return {double(vertex.at.x) / (root * side.nu), double(vertex.at.y) / (root * side.nv)};
}

Vec2 LatticeCells::place_in_element(const LatticeVertex& vertex) const {
  const MeshCell& cell = cell_of(mesh_, vertex.element);
  const std::int64_t width = (cell.flipped ? -1 : 1) * width_at(cell.level);
  const LatticePoint from = moved({0, 0}, {cell.i, cell.j}, width_at(cell.level));
  return {double(vertex.at.x - from.x) / double(width),
          double(vertex.at.y - from.y) / double(width)};
}

bool LatticeCells::is_at_border(const LatticeVertex& vertex) const {
  const MeshSide& side = mesh_.sides[index(mesh_.side_of_element[index(vertex.element)])];
  if (stands_apart(vertex.element))
    return true;
  const auto& [x, y] = vertex.at;
  const std::int64_t max_x = side.nu * width_at(0), max_y = side.nv * width_at(0);
  return x == 0 || y == 0 || (side.triangle ? x + y == max_x : x == max_x || y == max_y);
}

/// All vertices between two, the middle before what is between it and the ends.
static void add_hanging(const LatticeCells& cells, std::uint32_t a, std::uint32_t b,
                        std::vector<HangingCorner>& hanging) {
  const std::uint32_t middle = cells.middle_of(a, b);
  if (middle == LatticeCells::no_vertex)
    return;
  hanging.push_back({middle, a, b});
  add_hanging(cells, a, middle, hanging);
  add_hanging(cells, middle, b, hanging);
}

std::vector<HangingCorner> hanging_corners(const LatticeCells& all,
                                           std::vector<std::uint32_t> leaves) {
  const std::vector<LatticeCell>& cells = all.cells();
  // Edges are looked up where not both cells beside them were divided along them: at the ends of these.
  std::vector<std::uint8_t> times(all.vertices().size(), 0), is_end(times.size(), 0);
  for (const LatticeCell& cell : cells)
    if (cell.first_child != LatticeCell::leaf)
      for (const std::uint32_t middle : all.edge_middles(cell))
        if (middle != LatticeCells::no_vertex)
          ++times[middle];
  for (std::uint32_t v = 0; v < times.size(); ++v)
    if (const auto& between = all.vertices()[v].between; times[v] < 2 && between[0] != v)
      for (const std::uint32_t end : between)
        is_end[end] = 1;

  // Larger cells first: corners of smaller ones hang on them.
  std::ranges::stable_sort(leaves, {}, [&](std::uint32_t c) { return cells[c].level; });
  std::vector<HangingCorner> hanging;
  for (const std::uint32_t c : leaves) {
    const std::size_t count = all.is_triangle(cells[c]) ? 3 : 4;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t a = cells[c].corners[k], b = cells[c].corners[(k + 1) % count];
      if (is_end[a] != 0 && is_end[b] != 0)
        add_hanging(all, a, b, hanging);
    }
  }
  return hanging;
}

} // namespace meninas
