// The storage of one tile of the picture: sums by way of seeing, and the specular paths that go on.
#pragma once

#include "radiosity/light/light_samples.h"
#include "raytrace/glossy_frustum.h"
#include "raytrace/beams/coherent_beam.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <array>
#include <vector>

namespace meninas {

/// A pixel's radiance by how it is seen: straight, in one mirror, by way of several.
inline constexpr std::size_t seen_ways = 3;
using SeenRadiance = std::array<glm::vec3, seen_ways>;

/// A specular path that goes on: where, in which pixel of the tile, with what throughput.
struct SpecularRay {
  glm::dvec3 origin, direction; ///< in the frame of the ray scene
  glm::vec3 throughput;
  float share = 1.0F; ///< of a camera ray's weight: 1 / n^2 for each of the n x n rays of a lobe
  std::uint32_t pixel;
  std::uint32_t leaving;
  std::uint32_t key;        ///< of its samples
  std::uint32_t number;     ///< of its camera ray among those of the pixel
  std::uint16_t lobes = 0;  ///< that it has gone through
  float travelled = 0.0F;   ///< from the eye, unfolded, in units of the camera direction's length
  std::uint16_t way = 0;    ///< how its pixel sees what it meets: index into SeenRadiance
  std::int32_t bounces = 0; ///< off mirrors and in lobes; what goes through glass is none
  // Since it left a lobe whose emitters are sampled as well (scattering.h):
  float density = 0.0F; ///< of the directions of that lobe's rays, per steradian; 0: there is none
  float since_lobe = 0.0F;              ///< metres
  MaterialId medium = none<MaterialId>; ///< the solid it has been refracted into
  WorldId world = none<WorldId>;
};

struct TileArea {
  int x0, y0, width, height;
};

/// The way of seeing behind that many mirrors more.
inline std::uint16_t more_mirrors(std::uint16_t way, int mirrors) {
  return static_cast<std::uint16_t>(std::min(way + mirrors, int{seen_ways - 1}));
}
inline std::uint16_t one_more_mirror(std::uint16_t way) { return more_mirrors(way, 1); }

struct TileWorkspace {
  std::array<std::vector<glm::vec3>, seen_ways>
      sums; ///< by way of seeing, then by pixel of the tile
  std::vector<SpecularRay> current, next;
  CoherentBeams sure;
  TileArea area{};
  std::vector<LobeRay> lobe;
  std::vector<PunctualArrival> highlights;
  std::vector<EmissionSample> lamps;
  PointWorkspace point;        ///< of diffuse terms computed at the hit
  std::uint64_t camera_rays = 0, specular_rays = 0;
  std::uint64_t sure_rays = 0; ///< of these, not traced
};

/// A seed of the pixel's own, wherever tiles begin.
inline std::uint32_t pixel_seed(const TileArea& area, std::uint32_t pixel, std::uint32_t seed) {
  const auto width = static_cast<std::uint32_t>(area.width);
  return hash(static_cast<std::uint32_t>(area.x0) + pixel % width,
              static_cast<std::uint32_t>(area.y0) + pixel / width, hash(seed, 0x10be));
}

} // namespace meninas
