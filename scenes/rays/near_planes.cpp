#include "scenes/rays/near_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace meninas {

namespace {

constexpr double max_tests = 2e7; // of a triangle beside a plane: some hundredths of a second
constexpr std::size_t max_slabs =
    64; // of a plane; to test more takes longer than to search for contacts
constexpr double grazing = 0.05; ///< sine: the lift passes a band 20 times as wide as it is high
constexpr double float_rounding = 1e-6; // of a height, generously, in [-1, 1]

struct Box {
  Point3 low{std::numeric_limits<double>::infinity()};
  Point3 high{-std::numeric_limits<double>::infinity()};
};

/// What is known of the surfaces of a plane class.
struct Extent {
  Box box;
  double grain = 1.0;                                   ///< the largest of its points
  double low = std::numeric_limits<double>::infinity(); ///< heights along the plane's normal
  double high = -std::numeric_limits<double>::infinity();
};

Box box_of(const std::array<Point3, 3>& corners) {
  return {glm::min(corners[0], glm::min(corners[1], corners[2])),
          glm::max(corners[0], glm::max(corners[1], corners[2]))};
}

bool overlap(const Box& a, const Box& b, double margin) {
  return glm::all(glm::lessThanEqual(a.low, b.high + margin)) &&
         glm::all(glm::lessThanEqual(b.low, a.high + margin));
}

std::vector<Extent> find_extents(const FrameGeometry& geometry) {
  std::vector<Extent> extents(geometry.plane_normals.size());
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    const auto plane = geometry.facts[t].plane;
    const auto corners = corners_of(geometry, t);
    const auto box = box_of(corners);
    auto& extent = extents[plane];
    extent.box = {glm::min(extent.box.low, box.low), glm::max(extent.box.high, box.high)};
    for (const auto& corner : corners) {
      const auto height = glm::dot(geometry.plane_normals[plane], corner);
      extent.low = std::min(extent.low, height);
      extent.high = std::max(extent.high, height);
    }
  }
  for (auto& extent : extents) {
    const glm::vec3 farthest(glm::max(-extent.box.low, extent.box.high));
    extent.grain = double{grain_at(geometry, farthest)};
  }
  return extents;
}

std::vector<Box> boxes_of(const FrameGeometry& geometry) {
  std::vector<Box> boxes;
  boxes.reserve(geometry.triangles.size());
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t)
    boxes.push_back(box_of(corners_of(geometry, t)));
  return boxes;
}

/// What comes near a plane.
struct Neighbours {
  std::vector<std::uint32_t> planes;
  bool graze = false; ///< one that is not glass crosses it at a small angle
};

/// The plane classes of the triangles that come near a plane within the box of its surfaces.
/// `boxes` by triangle: most are far away.
Neighbours planes_near(const FrameGeometry& geometry, std::span<const Box> boxes,
                                       const Extent& extent, std::uint32_t plane, double reach) {
  const auto margin = extent.grain * (2.0 * reach + float_rounding);
  const auto& normal = geometry.plane_normals[plane];
  Neighbours near;
  std::vector<std::uint32_t>& found = near.planes;
  for (std::uint32_t t = 0; t < geometry.triangles.size() && found.size() <= max_slabs; ++t) {
    if (!overlap(extent.box, boxes[t], margin))
      continue;
    const auto other = geometry.facts[t].plane;
    if (other == plane)
      continue;
    const auto corners = corners_of(geometry, t);
    const std::array heights{glm::dot(normal, corners[0]), glm::dot(normal, corners[1]),
                             glm::dot(normal, corners[2])};
    const auto [low, high] = std::ranges::minmax(heights);
    if (low > extent.high + margin || high < extent.low - margin)
      continue;
    const double rounding = extent.grain * float_rounding;
    near.graze |= low < extent.low - rounding && high > extent.high + rounding &&
                  !geometry.facts[t].glass &&
                  glm::length(glm::cross(normal, geometry.plane_normals[other])) < grazing;
    if (std::ranges::find(found, other) == found.end())
      found.push_back(other);
  }
  return near;
}

/// `margin` is how far around it a point is not off it.
Slab slab_of(const Direction& normal, const Extent& extent, double margin) {
  const glm::vec3 n(normal);
  return {n.x, n.y, n.z, static_cast<float>(0.5 * (extent.low + extent.high)),
          static_cast<float>(0.5 * (extent.high - extent.low) + margin)};
}

/// The lanes whose origin is off all slabs.
LaneFlags lanes_off(std::span<const Slab> slabs, const RayPacket& packet) {
  LaneFlags off;
  off.fill(-1);
  for (const auto& slab : slabs)
    for (std::size_t k = 0; k < packet_size; ++k) {
      const auto height = slab.x * packet.origin_x[k] + slab.y * packet.origin_y[k] +
                          slab.z * packet.origin_z[k] - slab.height;
      off[k] &= std::abs(height) > slab.half_width ? -1 : 0;
    }
  return off;
}

} // namespace

/// The planes of the largest surfaces first: most rays leave them.
static std::vector<std::uint32_t> by_size(const std::vector<Extent>& extents) {
  std::vector<std::uint32_t> order(extents.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t plane) {
    return glm::length(extents[plane].box.high - extents[plane].box.low);
  });
  return order;
}

NearPlanes find_near_planes(const FrameGeometry& geometry, double reach) {
  const auto extents = find_extents(geometry);
  const auto triangles = static_cast<double>(std::max<std::size_t>(1, geometry.triangles.size()));
  const auto tested =
      std::min(extents.size(), static_cast<std::size_t>(std::ceil(max_tests / triangles)));
  const auto order = by_size(extents);
  const std::vector<Box> boxes = boxes_of(geometry);
  std::vector<Neighbours> found(tested);
  tbb::parallel_for(std::size_t{0}, tested, [&](std::size_t p) {
    found[p] = planes_near(geometry, boxes, extents[order[p]], order[p], reach);
  });

  NearPlanes near;
  near.ranges.resize(extents.size());
  near.is_grazed.assign(extents.size(), 0);
  for (std::size_t p = 0; p < tested; ++p) {
    near.is_grazed[order[p]] = found[p].graze ? 1 : 0;
    near.any_grazed |= found[p].graze;
    if (found[p].planes.size() > max_slabs)
      continue;
    const auto begin = static_cast<std::uint32_t>(near.slabs.size());
    const double margin = extents[order[p]].grain * (reach + float_rounding);
    for (const auto other : found[p].planes)
      near.slabs.push_back(slab_of(geometry.plane_normals[other], extents[other], margin));
    near.ranges[order[p]] = {begin, static_cast<std::uint32_t>(near.slabs.size())};
  }
  return near;
}

std::uint32_t lanes_off_all_else(const NearPlanes& near, const RayPacket& packet,
                                 std::uint32_t asked) {
  std::uint32_t certain = 0;
  while (asked != 0) {
    // All lanes that leave the same plane are tested together.
    const auto plane = packet.leaving[std::countr_zero(asked)];
    std::uint32_t together = 0;
    for (std::uint32_t k = 0; k < packet_size; ++k)
      together |= packet.leaving[k] == plane ? 1U << k : 0U;
    together &= asked;
    asked &= ~together;
    if (plane >= near.ranges.size() || near.ranges[plane].end == NearPlanes::unknown)
      continue;
    const auto& [begin, end] = near.ranges[plane];
    certain |=
        together & bits_of(lanes_off(std::span(near.slabs).subspan(begin, end - begin), packet));
  }
  return certain;
}

std::uint32_t lanes_at_grazing_faces(const NearPlanes& near, const RayPacket& packet) {
  std::uint32_t grazed = 0;
  if (!near.any_grazed)
    return grazed;
  for (std::uint32_t k = 0; k < packet.count; ++k)
    if (packet.leaving[k] < near.is_grazed.size() && near.is_grazed[packet.leaving[k]] != 0)
      grazed |= 1U << k;
  return grazed & ~lanes_off_all_else(near, packet, grazed);
}

} // namespace meninas
