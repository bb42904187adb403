// Shared vertices by position:
// those of one surface side that round to the same place are one vertex.
#pragma once

#include "radiosity/mesh/element_mesh.h"

#include <cmath>
#include <unordered_map>

namespace meninas {

class VertexWelder {
public:
  /// Points are the same within about `grain`, metres.
  /// `expected`: about as many as there will be.
  explicit VertexWelder(double grain, std::size_t expected = 0) : grain_(grain) {
    known_.reserve(expected);
  }

  /// The vertex there, which is appended if it is new.
  ElementVertexId vertex_at(std::uint64_t surface_side, const Point3& x,
                            std::vector<Point3>& vertices) {
    const auto [entry, is_new] =
        known_.try_emplace(key_of(surface_side, x), static_cast<ElementVertexId>(vertices.size()));
    if (is_new)
      vertices.push_back(x);
    return entry->second;
  }

  /// The vertex there; none if there is none.
  ElementVertexId find(std::uint64_t surface_side, const Point3& x) const {
    const auto entry = known_.find(key_of(surface_side, x));
    return entry == known_.end() ? none<ElementVertexId> : entry->second;
  }

private:
  struct Key {
    std::int64_t x, y, z;
    std::uint64_t surface_side;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = k.surface_side * 0x9e3779b97f4a7c15ULL;
      for (const std::int64_t c : {k.x, k.y, k.z})
        h = (h ^ static_cast<std::uint64_t>(c)) * 0xff51afd7ed558ccdULL + (h >> 29U);
      return h;
    }
  };

  Key key_of(std::uint64_t surface_side, const Point3& x) const {
    const auto place = [this](double c) {
      return static_cast<std::int64_t>(std::floor(c / grain_ + 0.37));
    };
    return {place(x.x), place(x.y), place(x.z), surface_side};
  }

  double grain_;
  std::unordered_map<Key, ElementVertexId, KeyHash> known_;
};

} // namespace meninas
