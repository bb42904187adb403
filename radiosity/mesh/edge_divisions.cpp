#include "radiosity/mesh/edge_divisions.h"

#include "scenes/surfaces/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace meninas {

namespace {

constexpr int largest_division = 4096;

int wanted(double length, double element_size) {
  return static_cast<int>(
      std::clamp(std::ceil(length / element_size - 1e-6), 1.0, double{largest_division}));
}

/// The divisions that a patch would choose alone.
/// Slivers count by their area, lest a long thin triangle be cut into thousands.
Divisions own_divisions(const Patch& patch, double element_size) {
  const auto edge = [&patch](int a, int b) {
    return glm::distance(patch.corners[a], patch.corners[b]);
  };
  if (patch.corner_count == 3) {
    const int n = wanted(std::sqrt(2.0 * patch.area), element_size);
    return {n, n};
  }
  return {wanted(std::max(edge(0, 1), edge(3, 2)), element_size),
          wanted(std::max(edge(1, 2), edge(0, 3)), element_size)};
}

using Cell = std::array<std::int64_t, 3>;
using EdgeKey = std::tuple<std::uint32_t, Cell, Cell>;

/// An edge by its surface and its end points on a grid coarser than their rounding.
EdgeKey edge_key(const Patch& patch, int a, int b, double cell) {
  const auto place = [cell](const Point3& x) {
    Cell c;
    for (int k = 0; k < 3; ++k)
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(x[k] / cell + 0.37));
    return c;
  };
  auto low = place(patch.corners[static_cast<std::size_t>(a)]),
       high = place(patch.corners[static_cast<std::size_t>(b)]);
  if (high < low)
    std::swap(low, high);
  return {index(patch.surface), low, high};
}

} // namespace

std::vector<Divisions> divide_edges(const SurfaceModel& surfaces,
                                    std::span<const double> element_size, double max_times) {
  const auto& patches = surfaces.patches;

  // Class 2p holds the edges of patch p along u, class 2p + 1 those along v.
  DisjointSets classes(2 * patches.size());
  std::map<EdgeKey, std::uint32_t> class_of_edge;
  const double cell = std::max(16.0 * surfaces.tolerance, 1e-300);
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    const Patch& patch = patches[p];
    if (surfaces.surfaces[index(patch.surface)].patches.size() < 2)
      continue;
    if (patch.corner_count == 3)
      classes.join(2 * p, 2 * p + 1);
    for (int a = 0; a < patch.corner_count; ++a) {
      const std::uint32_t own =
          2 * p + (patch.corner_count == 4 ? static_cast<std::uint32_t>(a % 2) : 0U);
      const auto [entry, is_new] =
          class_of_edge.emplace(edge_key(patch, a, (a + 1) % patch.corner_count, cell), own);
      if (!is_new)
        classes.join(own, entry->second);
    }
  }

  std::vector<int> largest(2 * patches.size(), 1);
  std::vector<Divisions> divisions(patches.size());
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    divisions[p] = own_divisions(patches[p], element_size[index(patches[p].surface)]);
    auto& u = largest[classes.root(2 * p)];
    u = std::max(u, divisions[p].u);
    auto& v = largest[classes.root(2 * p + 1)];
    v = std::max(v, divisions[p].v);
  }
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    const int u = largest[classes.root(2 * p)], v = largest[classes.root(2 * p + 1)];
    if (patches[p].corner_count == 3) {
      if (u <= max_times * divisions[p].u)
        divisions[p] = {u, u};
      continue;
    }
    if (u <= max_times * divisions[p].u)
      divisions[p].u = u;
    if (v <= max_times * divisions[p].v)
      divisions[p].v = v;
  }
  return divisions;
}

} // namespace meninas
