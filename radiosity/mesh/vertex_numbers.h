// The numbers of a mesh's vertices: in the order in which its elements mention them.
//
// When a mesh is divided, most elements stay and keep their vertices. Only new elements look vertices
// up by place, among the old vertices that they may share. The numbers are those of a mesh that is
// made anew.
#pragma once

#include "radiosity/mesh/vertex_welder.h"

#include <span>

namespace meninas {

class VertexNumbers {
public:
  /// Points are the same within about `grain`, metres; `before`: so many vertices there were.
  VertexNumbers(double grain, std::size_t before)
      : welder_(grain), numbers_(before, none<ElementVertexId>) {}

  /// Vertex `before` is where new elements may have a corner.
  void place(std::uint64_t surface_side, const Point3& x, ElementVertexId before) {
    slot_at(surface_side, x, index(before));
  }

  /// The number of a vertex there was, which is appended if no element has mentioned it so far.
  ElementVertexId number_of(ElementVertexId before, const Point3& x,
                            std::vector<Point3>& vertices) {
    return numbered(index(before), x, vertices);
  }

  /// The vertex at a point, likewise.
  ElementVertexId vertex_at(std::uint64_t surface_side, const Point3& x,
                            std::vector<Point3>& vertices) {
    const std::uint32_t slot =
        slot_at(surface_side, x, static_cast<std::uint32_t>(numbers_.size()));
    if (slot == numbers_.size())
      numbers_.push_back(none<ElementVertexId>);
    return numbered(slot, x, vertices);
  }

  /// Vertices at the corners of an element that shares its surface with no other: those that round to
  /// one place are one. They have no place, as nobody else asks for them.
  ElementCorners vertices_apart(std::span<const Point3> points, std::vector<Point3>& vertices) {
    ElementCorners corners{};
    for (std::size_t c = 0; c < points.size(); ++c) {
      std::size_t same = 0;
      while (same < c && !welder_.is_one_place(points[same], points[c]))
        ++same;
      if (same < c) {
        corners[c] = corners[same];
        continue;
      }
      numbers_.push_back(none<ElementVertexId>);
      corners[c] = numbered(static_cast<std::uint32_t>(numbers_.size() - 1), points[c], vertices);
    }
    return corners;
  }

  /// The vertex there, of those that have a place; none if there is none.
  ElementVertexId find(std::uint64_t surface_side, const Point3& x) const {
    const ElementVertexId place = welder_.find(surface_side, x);
    return place == none<ElementVertexId> ? place : numbers_[slots_[index(place)]];
  }

private:
  /// The slot at a place, which is `otherwise` where there was none.
  std::uint32_t slot_at(std::uint64_t surface_side, const Point3& x, std::uint32_t otherwise) {
    const ElementVertexId place = welder_.vertex_at(surface_side, x, places_);
    if (index(place) == slots_.size())
      slots_.push_back(otherwise);
    return slots_[index(place)];
  }
  ElementVertexId numbered(std::uint32_t slot, const Point3& x, std::vector<Point3>& vertices) {
    if (numbers_[slot] == none<ElementVertexId>) {
      numbers_[slot] = static_cast<ElementVertexId>(vertices.size());
      vertices.push_back(x);
    }
    return numbers_[slot];
  }

  VertexWelder welder_;
  std::vector<Point3> places_;
  std::vector<std::uint32_t> slots_;     ///< by place
  std::vector<ElementVertexId> numbers_; ///< by slot: of the vertices before, then of new ones
};

} // namespace meninas
