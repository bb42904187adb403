// A hash grid that lists the points near a point, in expected constant time. Deterministic: points
// come in the order they were added, per cell.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace meninas {

template <std::size_t Dimensions>
class NeighbourGrid {
public:
  using Point = std::array<double, Dimensions>;

  /// Cells of a few look-up radii make most look-ups touch few cells with few points.
  NeighbourGrid(double cell, std::size_t expected_items)
      : cell_(cell), lists_(std::bit_ceil(2 * expected_items + 1)) {
    items_.reserve(expected_items);
  }

  void add(const Point& point, std::uint32_t item) {
    List& list = lists_[slot_of(cell_of(point))];
    const auto entry = static_cast<std::uint32_t>(items_.size());
    items_.push_back({point, item, end});
    (list.first == end ? list.first : items_[list.last].next) = entry;
    list.last = entry;
  }

  /// Calls visit(item) for all items within `radius` of the point along each axis until it returns
  /// false, maybe twice for one item.
  template <typename Visit>
  void visit_near(const Point& point, double radius, Visit&& visit) const {
    Point low = point;
    Point high = point;
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      low[axis] -= radius;
      high[axis] += radius;
    }
    const Coordinates first = cell_of(low);
    const Coordinates last = cell_of(high);
    Coordinates at = first;
    while (true) {
      if (!visit_cell(at, low, high, visit)) {
        return;
      }
      std::size_t axis = 0;
      while (axis < Dimensions && !(at[axis] < last[axis])) {
        at[axis] = first[axis];
        ++axis;
      }
      if (axis == Dimensions) {
        return;
      }
      at[axis] += 1.0;
    }
  }

private:
  using Coordinates = std::array<double, Dimensions>;
  static constexpr std::uint32_t end = 0xffffffffU;
  struct List {
    std::uint32_t first = end;
    std::uint32_t last = end;
  };
  struct Item {
    Point point;
    std::uint32_t item;
    std::uint32_t next;
  };

  Coordinates cell_of(const Point& point) const {
    Coordinates cell{};
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      cell[axis] = std::floor(point[axis] / cell_);
    }
    return cell;
  }

  /// Cells may share a list; what does not belong to a look-up is filtered out there.
  std::size_t slot_of(const Coordinates& cell) const {
    std::uint64_t key = 0x9e3779b97f4a7c15ULL;
    for (const double x : cell) {
      key = (key ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0xbf58476d1ce4e5b9ULL;
      key ^= key >> 29;
    }
    return (key ^ key >> 32) & (lists_.size() - 1);
  }

  template <typename Visit>
  bool visit_cell(const Coordinates& cell, const Point& low, const Point& high,
                  Visit& visit) const {
    for (std::uint32_t entry = lists_[slot_of(cell)].first; entry != end;
         entry = items_[entry].next) {
      const Item& candidate = items_[entry];
      bool near = true;
      for (std::size_t axis = 0; axis < Dimensions; ++axis) {
        near = near && low[axis] <= candidate.point[axis] && candidate.point[axis] <= high[axis];
      }
      if (near && !visit(candidate.item)) {
        return false;
      }
    }
    return true;
  }

  double cell_;
  std::vector<List> lists_;
  std::vector<Item> items_;
};

} // namespace meninas
