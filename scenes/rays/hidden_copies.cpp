#include "scenes/rays/hidden_copies.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace meninas {
namespace {

/// A face and a number made of its corners, whatever their order.
struct Copy {
  std::uint64_t key = 0;
  TriangleId triangle = none<TriangleId>;
};

std::uint64_t hash_of(const Point3& x) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x[axis] + 0.0)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

enum class SameCorners { no, same_way, other_way };

SameCorners compare(const Scene& scene, TriangleId first, TriangleId second) {
  const auto a = corners(scene, first);
  const auto b = corners(scene, second);
  for (std::size_t k = 0; k < 3; ++k) {
    if (a[0] != b[k]) {
      continue;
    }
    if (a[1] == b[(k + 1) % 3] && a[2] == b[(k + 2) % 3]) {
      return SameCorners::same_way;
    }
    if (a[1] == b[(k + 2) % 3] && a[2] == b[(k + 1) % 3]) {
      return SameCorners::other_way;
    }
  }
  return SameCorners::no;
}

/// Whether wherever `below` could be seen from, `above` is.
bool can_hide(const Material& above, const Material& below, SameCorners corners) {
  const bool both_ways = above.double_sided;
  const bool opaque = above.alpha_mode != AlphaMode::mask && above.transmission == 0.0;
  const bool keeps_light = is_emitter(above) || !is_emitter(below);
  return opaque && keeps_light && (both_ways || corners == SameCorners::same_way) &&
         (both_ways || !below.double_sided);
}

} // namespace

std::vector<bool> hidden_copies(const Scene& scene) {
  std::vector<Copy> copies;
  copies.reserve(scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto p = corners(scene, TriangleId{t});
    copies.push_back({hash_of(p[0]) + hash_of(p[1]) + hash_of(p[2]), TriangleId{t}});
  }
  std::ranges::sort(copies, [](const Copy& a, const Copy& b) {
    return std::tie(a.key, a.triangle) < std::tie(b.key, b.triangle);
  });
  std::vector<bool> hidden(scene.triangles.size(), false);
  const auto settle = [&](TriangleId first, TriangleId second) {
    const SameCorners same = compare(scene, first, second);
    if (same == SameCorners::no || hidden[index(first)] || hidden[index(second)]) {
      return;
    }
    const Material& a = material_of(scene, first);
    const Material& b = material_of(scene, second);
    if (can_hide(a, b, same)) {
      hidden[index(second)] = true;
    } else if (can_hide(b, a, same)) {
      hidden[index(first)] = true;
    }
  };
  // Copies of one face are few; of very many the first ones settle it.
  constexpr std::size_t max_copies = 64;
  for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
    for (end = begin; end < copies.size() && copies[end].key == copies[begin].key;) {
      ++end;
    }
    for (std::size_t a = begin; a < std::min(end, begin + max_copies); ++a) {
      for (std::size_t b = a + 1; b < end && !hidden[index(copies[a].triangle)]; ++b) {
        settle(copies[a].triangle, copies[b].triangle);
      }
    }
  }
  return hidden;
}

} // namespace meninas
