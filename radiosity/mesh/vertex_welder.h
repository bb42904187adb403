// Shared vertices by position:
// those of one surface side that round to the same place are one vertex.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <cmath>
#include <vector>

namespace meninas {

class VertexWelder {
public:
  /// Points are the same within about `grain`, metres.
  explicit VertexWelder(double grain) : grain_(grain), slots_(16, empty) {}

  /// The vertex there, which is appended if it is new.
  ElementVertexId vertex_at(std::uint64_t surface_side, const Point3& x,
                            std::vector<Point3>& vertices) {
    const Key key = key_of(surface_side, x);
    std::size_t slot = slot_of(key);
    if (slots_[slot] != empty)
      return known_[slots_[slot]].vertex;
    if (2 * known_.size() >= slots_.size()) {
      grow();
      slot = slot_of(key);
    }
    slots_[slot] = static_cast<std::uint32_t>(known_.size());
    known_.push_back({key, static_cast<ElementVertexId>(vertices.size())});
    vertices.push_back(x);
    return known_.back().vertex;
  }

  /// The vertex there; none if there is none.
  ElementVertexId find(std::uint64_t surface_side, const Point3& x) const {
    const std::uint32_t known = slots_[slot_of(key_of(surface_side, x))];
    return known == empty ? none<ElementVertexId> : known_[known].vertex;
  }

  bool is_one_place(const Point3& a, const Point3& b) const { return key_of(0, a) == key_of(0, b); }

private:
  struct Key {
    std::int64_t x, y, z;
    std::uint64_t surface_side;
    bool operator==(const Key&) const = default;
  };
  struct Known {
    Key key;
    ElementVertexId vertex;
  };
  static constexpr std::uint32_t empty = 0xffffffffU;

  /// That of the key, or the empty one where it belongs (open addressing, half full at most).
  std::size_t slot_of(const Key& k) const {
    std::uint64_t h = k.surface_side * 0x9e3779b97f4a7c15ULL;
    for (const std::int64_t c : {k.x, k.y, k.z})
      h = (h ^ static_cast<std::uint64_t>(c)) * 0xff51afd7ed558ccdULL + (h >> 29U);
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (h ^ h >> 32U) & mask;
    while (slots_[slot] != empty && !(known_[slots_[slot]].key == k))
      slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), empty);
    for (std::uint32_t k = 0; k < known_.size(); ++k)
      slots_[slot_of(known_[k].key)] = k;
  }

  Key key_of(std::uint64_t surface_side, const Point3& x) const {
    const auto place = [this](double c) {
      return static_cast<std::int64_t>(std::floor(c / grain_ + 0.37));
    };
    return {place(x.x), place(x.y), place(x.z), surface_side};
  }

  double grain_;
  std::vector<Known> known_;
  std::vector<std::uint32_t> slots_; ///< of a hash table, in known_
};

} // namespace meninas
