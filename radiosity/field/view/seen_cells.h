// Cells with what is seen of them: the points of the field that a view shows, a pixel apart, by the cell that they
// are in, and how wide a cell is in pixels.
#pragma once

#include "radiosity/field/view/lattice_cells.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace meninas {

/// A point of the field that the view shows.
struct SeenPoint {
  std::uint32_t element; ///< index of an ElementId
  glm::vec2 st;          ///< in it
  float width;           ///< of a pixel there, metres
  float lit = 0.0F;      ///< irradiance that punctual lights send, W/m^2, its brightest channel
};

class SeenCells {
public:
  /// Whether direct light differs between the corners of an element of so many pixels.
  using HasEdge = std::function<bool(ElementId, double pixels)>;

  /// The elements that points are in, but for those within a pixel without an edge, which show what their corners
  /// have. Points are a pixel apart, or `apart` pixels. `lit` says what a point receives from punctual lights; empty:
  /// nothing.
  SeenCells(const ElementMesh& mesh, std::vector<SeenPoint> seen, double apart, const HasEdge& has_edge,
            const std::function<float(const SeenPoint&)>& lit);

  const LatticeCells& lattice() const { return lattice_; }
  std::size_t roots() const { return roots_; }
  std::uint32_t root_of(ElementId element) const { return root_of_[index(element)]; }

  double apart() const { return apart_; }

  /// The number of points in a cell, and its longest edge in pixels of the narrowest; 0 where the cell is unseen.
  std::size_t points(std::uint32_t cell) const { return ranges_[cell].end - ranges_[cell].first; }
  double pixels(std::uint32_t cell) const { return ranges_[cell].pixels; }

  /// The least and the most that punctual lights send to its points; the least is more where it has none.
  float min_lit(std::uint32_t cell) const { return ranges_[cell].min_lit; }
  float max_lit(std::uint32_t cell) const { return ranges_[cell].max_lit; }

  /// The extent that a vertex stands for: the pixels of the largest cell that has it for a corner.
  double pixels_of_vertex(std::uint32_t vertex) const { return double{pixels_of_vertex_[vertex]}; }

  /// Into four. Its points go to the children they are in. Where these are hardly larger than points are
  /// apart, a child without points is seen as the others are.
  void divide(std::uint32_t cell);

private:
  struct Range {
    std::size_t first = 0, end = 0; ///< of the points
    double pixels = 0.0;
    float min_lit = std::numeric_limits<float>::infinity(), max_lit = 0.0F;
  };

  Range range_of(std::size_t first, std::size_t end, double edge) const;
  void stand_for(std::uint32_t cell);

  const ElementMesh& mesh_;
  double apart_;
  std::vector<SeenPoint> seen_; ///< by cell, their places in it
  LatticeCells lattice_;
  std::size_t roots_;
  std::vector<Range> ranges_; ///< by cell
  std::vector<float> pixels_of_vertex_;
  std::vector<std::uint32_t> root_of_; ///< by ElementId
};

} // namespace meninas
