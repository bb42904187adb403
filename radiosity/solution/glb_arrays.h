// The binary chunk of a GLB as it grows, with the buffer views and accessors of glTF 2.0 that
// describe it: arrays of floats and of indices, and bytes without an accessor.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace meninas {

inline constexpr int gltf_float = 5126;
inline constexpr int gltf_unsigned_int = 5125;

struct GlbArrays {
  std::vector<std::byte> binary;
  nlohmann::json views = nlohmann::json::array();
  nlohmann::json accessors = nlohmann::json::array();
};

/// An array as one view, which several accessors may take parts of: all start at multiples of four.
/// Returns the number of the view. `is_indices`: of triangles, else an attribute of vertices.
template <typename Item>
std::size_t add_view(GlbArrays& glb, const std::vector<Item>& items, bool is_indices) {
  constexpr int array_buffer = 34962, element_array_buffer = 34963;
  static_assert(sizeof(Item) % 4 == 0);
  glb.binary.resize((glb.binary.size() + 3) / 4 * 4);
  const auto bytes = std::as_bytes(std::span(items));
  glb.views.push_back({{"buffer", 0},
                       {"byteOffset", glb.binary.size()},
                       {"byteLength", bytes.size()},
                       {"target", is_indices ? element_array_buffer : array_buffer}});
  if (!is_indices)
    glb.views.back()["byteStride"] = sizeof(Item);
  glb.binary.insert(glb.binary.end(), bytes.begin(), bytes.end());
  return glb.views.size() - 1;
}

/// `count` items from byte `offset` of a view on. Returns the number of the accessor.
inline std::size_t add_accessor(GlbArrays& glb, std::size_t view, std::size_t offset,
                                std::size_t count, nlohmann::json accessor) {
  accessor["bufferView"] = view;
  accessor["byteOffset"] = offset;
  accessor["count"] = count;
  glb.accessors.push_back(std::move(accessor));
  return glb.accessors.size() - 1;
}

/// Bytes without an accessor. Returns the number of their view.
inline std::size_t add_bytes(GlbArrays& glb, std::span<const std::byte> bytes) {
  glb.views.push_back(
      {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", bytes.size()}});
  glb.binary.insert(glb.binary.end(), bytes.begin(), bytes.end());
  return glb.views.size() - 1;
}

} // namespace meninas
