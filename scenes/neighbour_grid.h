// A hash grid that lists the points near a point, in expected constant time. Deterministic: points come in the order they
// were added, per cell.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace meninas {

template <std::size_t Dimensions>
class NeighbourGrid {
public:
  using Point = std::array<double, Dimensions>;

  /// Finds everything within `radius` along each axis. Cells of eight radii make most look-ups touch one cell.
  explicit NeighbourGrid(double radius) : radius_(radius), cell_(8.0 * radius) {}

  void add(const Point& point, std::uint32_t item) {
    Cell& cell = cells_.try_emplace(key_of(cell_of(point))).first->second;
    const auto entry = static_cast<std::uint32_t>(items_.size());
    items_.push_back({item, end});
    (cell.first == end ? cell.first : items_[cell.last].next) = entry;
    cell.last = entry;
  }

  /// Calls visit(item) for all items near the point, and maybe some farther ones, until it returns false.
  template <typename Visit>
  void visit_near(const Point& point, Visit&& visit) const {
    Point low = point;
    Point high = point;
    for (std::size_t axis = 0; axis < Dimensions; ++axis) {
      low[axis] -= radius_;
      high[axis] += radius_;
    }
    const Coordinates first = cell_of(low);
    const Coordinates last = cell_of(high);
    Coordinates at = first;
    while (true) {
      if (!visit_cell(at, visit)) {
        return;
      }
      std::size_t axis = 0;
      while (axis < Dimensions && at[axis] == last[axis]) {
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
  struct Cell {
    std::uint32_t first = end;
    std::uint32_t last = end;
  };
  struct Item {
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

  /// Two cells of one key only share their lists, which visitors have to bear anyway.
  static std::uint64_t key_of(const Coordinates& cell) {
    std::uint64_t key = 0x9e3779b97f4a7c15ULL;
    for (const double x : cell) {
      key = (key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(x))) * 0xbf58476d1ce4e5b9ULL;
      key ^= key >> 29;
    }
    return key;
  }

  template <typename Visit>
  bool visit_cell(const Coordinates& cell, Visit& visit) const {
    const auto found = cells_.find(key_of(cell));
    if (found == cells_.end()) {
      return true;
    }
    for (std::uint32_t entry = found->second.first; entry != end; entry = items_[entry].next) {
      if (!visit(items_[entry].item)) {
        return false;
      }
    }
    return true;
  }

  double radius_;
  double cell_;
  std::unordered_map<std::uint64_t, Cell> cells_;
  std::vector<Item> items_;
};

} // namespace meninas
