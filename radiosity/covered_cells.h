// The covered part of a receiver: what stands on it, no light can reach.
#pragma once

#include "radiosity/light_scene.h"
#include "radiosity/receiver_rays.h"

#include <bit>
#include <span>

namespace meninas {

/// The covered part of a receiver, by cells of 8 x 8 over its (s, t): bit 8 i + j is cell (i, j).
/// Where the rays of a cell, if it has any, meet black backs at once, and all along the surface do,
/// something stands on that part of it: no light can reach it, and nothing sees it.
using CoveredCells = std::uint64_t;
inline std::uint32_t cell_of(double s, double t) {
  return 8U * static_cast<std::uint32_t>(8.0 * s) + static_cast<std::uint32_t>(8.0 * t);
}
inline bool is_covered(CoveredCells covered, double s, double t) {
  return ((covered >> cell_of(s, t)) & 1U) != 0;
}

/// The share of a receiver's area on which nothing stands.
inline float exposed_share(CoveredCells covered) {
  return 1.0F - static_cast<float>(std::popcount(covered)) / 64.0F;
}
/// The share of an element's area that is there, and on which nothing stands.
inline float exposed_share(const ElementMesh& mesh, std::size_t element, CoveredCells covered) {
  return mesh.solid[element] * exposed_share(covered);
}

struct Covered {
  CoveredCells cells = 0;
  std::uint32_t rays = 0; ///< of the net, from these cells
};

/// `black_lanes`: by packet of the net, the rays that met a black back at once.
Covered find_covered(const LightScene& light, const DirectionNet& net, const RaySource& source,
                     std::span<const std::uint32_t> black_lanes);

} // namespace meninas
