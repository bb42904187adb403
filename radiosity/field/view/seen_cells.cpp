#include "radiosity/field/view/seen_cells.h"

#include "radiosity/mesh/cell_children.h"
#include "radiosity/mesh/mesh_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace meninas {

namespace {

double longest_edge(const ElementMesh& mesh, ElementId element) {
  return longest_edge(mesh, mesh.corners[index(element)]);
}

/// The elements that points are in, by their order.
std::vector<ElementId> elements_of(std::span<const SeenPoint> seen) {
  std::vector<ElementId> elements;
  for (const SeenPoint& point : seen)
    if (elements.empty() || index(elements.back()) != point.element)
      elements.push_back(ElementId{point.element});
  return elements;
}

/// By element, without those within a pixel that tell nothing of an edge.
std::vector<SeenPoint> sorted(const ElementMesh& mesh, std::vector<SeenPoint> seen,
                              const SeenCells::HasEdge& has_edge) {
  std::ranges::stable_sort(seen, {}, &SeenPoint::element);
  auto kept = seen.begin();
  for (auto first = seen.begin(), end = first; first != seen.end(); first = end) {
    end = std::find_if(first, seen.end(),
                       [&](const SeenPoint& point) { return point.element != first->element; });
    const float narrowest = std::ranges::min_element(first, end, {}, &SeenPoint::width)->width;
    const ElementId element{first->element};
    const double pixels = longest_edge(mesh, element) / double{narrowest};
    if (pixels > 1.0 || has_edge(element, pixels))
      kept = std::move(first, end, kept);
  }
  seen.erase(kept, seen.end());
  return seen;
}

} // namespace

SeenCells::SeenCells(const ElementMesh& mesh, std::vector<SeenPoint> seen, double apart, const HasEdge& has_edge,
                     const std::function<float(const SeenPoint&)>& lit)
    : mesh_(mesh), apart_(apart), seen_(sorted(mesh, std::move(seen), has_edge)),
      lattice_(mesh, elements_of(seen_)), roots_(lattice_.cells().size()),
      root_of_(element_count(mesh), 0) {
  if (lit)
    tbb::parallel_for(std::size_t{0}, seen_.size(),
                      [&](std::size_t k) { seen_[k].lit = lit(seen_[k]); });
  std::size_t end = 0;
  for (std::uint32_t k = 0; k < roots_; ++k) {
    const ElementId element = lattice_.cells()[k].element;
    root_of_[index(element)] = k;
    const std::size_t first = end;
    while (end < seen_.size() && seen_[end].element == index(element))
      ++end;
    ranges_.push_back(range_of(first, end, longest_edge(mesh_, element)));
    stand_for(k);
  }
}

SeenCells::Range SeenCells::range_of(std::size_t first, std::size_t end, double edge) const {
  if (first == end)
    return {};
  float narrowest = std::numeric_limits<float>::infinity(), low = narrowest, high = 0.0F;
  for (std::size_t k = first; k < end; ++k) {
    narrowest = std::min(narrowest, seen_[k].width);
    low = std::min(low, seen_[k].lit);
    high = std::max(high, seen_[k].lit);
  }
  return {first, end, edge / double{narrowest}, low, high};
}

void SeenCells::stand_for(std::uint32_t cell) {
  pixels_of_vertex_.resize(lattice_.vertices().size(), 0.0F);
  for (const std::uint32_t v : lattice_.cells()[cell].corners)
    pixels_of_vertex_[v] = std::max(pixels_of_vertex_[v], static_cast<float>(ranges_[cell].pixels));
}

void SeenCells::divide(std::uint32_t number) {
  const Range range = ranges_[number];
  const ElementId element = lattice_.cells()[number].element;
  const bool triangle = lattice_.is_triangle(lattice_.cells()[number]);
  lattice_.divide(number);
  const std::uint32_t child = lattice_.cells()[number].first_child;
  const int levels = lattice_.cells()[child].level - cell_of(mesh_, element).level;
  const double edge = std::ldexp(longest_edge(mesh_, element), -levels);
  const auto child_of = [&](const SeenPoint& point) { return child_at(point.st, triangle).child; };
  const auto begin = seen_.begin() + static_cast<std::ptrdiff_t>(range.first),
             end = seen_.begin() + static_cast<std::ptrdiff_t>(range.end);
  std::ranges::stable_sort(begin, end, {}, child_of);
  std::size_t next = range.first;
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::size_t first = next;
    while (next != range.end && child_of(seen_[next]) == k)
      ++next;
    Range part = range_of(first, next, edge);
    if (first == next && range.pixels <= 4.0 * apart_)
      part = {.first = next, .end = next, .pixels = 0.5 * range.pixels};
    ranges_.push_back(part);
  }
  for (auto point = begin; point != end; ++point)
    point->st = child_at(point->st, triangle).st;
  for (std::uint32_t k = 0; k < 4; ++k)
    stand_for(child + k);
}

} // namespace meninas
