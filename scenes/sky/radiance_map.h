// The sky as a table: radiance by direction in equirectangular projection.
//
//   u = 1/2 + atan2(z, x) / 2 pi,   v = acos(y) / pi      of the direction turned back by the map's rotation about +Y
//
// so +X is in the middle of the picture, +Z a quarter to its right and +Y along its upper edge, as
// Blender and most viewers have it. Between the centres of texels, (i + 1/2) / w and (j + 1/2) / h,
// L is bilinear; it wraps around in u.
//
// The rays that gather light from everywhere seldom meet a small sun, and then it is too bright.
// Such suns are therefore found (radiance_map.cpp) and given as directional light, exactly as much
//
//   E_sun = integral of (L - L_without) dw      W/m^2 at normal incidence
//
// as the map without them lacks: who takes the light of `suns` looks at the rest (Suns::left_out).
// Error: their light has no penumbra, half a degree of the real sun's.
#pragma once

#include "scenes/types.h"

#include <cstdint>
#include <string>
#include <vector>

namespace meninas {

/// As seen from everywhere.
struct DistantSun {
  Direction towards{0.0, 1.0, 0.0};
  Rgb irradiance{0.0}; ///< at normal incidence, W/m^2
};

struct RadianceMap {
  std::string name; ///< for messages
  int width = 0, height = 0;
  std::vector<glm::vec3> texels;       ///< W/m^2/sr, row by row from the zenith
  bool edge_at_horizon = false;        ///< rows above and below the horizon are not interpolated
  double turned_cos = 1.0, turned_sin = 0.0; ///< of the rotation about +Y
  std::vector<DistantSun> suns;
  std::vector<glm::vec3> without_suns; ///< texels; empty where there are no suns
  std::uint64_t hash = 0;              ///< of all of it
};

/// The largest maps: 8 Mi texels are 96 MB, twice that with suns.
inline constexpr std::int64_t max_map_texels = std::int64_t{1} << 23;

enum class Suns { shown, left_out };

/// L(d); the direction need not be of unit length.
glm::vec3 radiance_from(const RadianceMap& map, const Vec3& direction, Suns suns);

/// (u, v) in [0, 1]^2; the direction need not be of unit length.
Vec2 place_of(const RadianceMap& map, const Vec3& direction);

/// The direction of a place (u, v) of the picture, in [0, 1]^2.
Direction direction_at(const RadianceMap& map, double u, double v);

/// A direction of the picture as it is after the map's rotation.
Direction turned(const RadianceMap& map, const Direction& d);

/// Solid angle of a texel in row j, sr: 2 pi / w (cos(pi j / h) - cos(pi (j + 1) / h)).
double texel_solid_angle(const RadianceMap& map, int row);

/// Mean radiance over the sphere, channel by channel, W/m^2/sr.
Rgb mean_radiance(const RadianceMap& map);

/// Mean of the brightest channel over the half about an axis, weighted by the cosine, without suns;
/// never 0. A mean of a few hundred directions, for choices and scales.
double mean_beyond(const RadianceMap& map, const Direction& axis);

/// The faults of a picture's texels, which a map does not have.
struct TexelFaults {
  std::int64_t not_numbers = 0, negative = 0, infinite = 0;
  int reduced = 1; ///< so many texels along each axis have become one
};

/// Texels that are no radiance are replaced (NaN and negative by 0, infinity and what is over
/// 1e30 by that), texels beyond `max_map_texels` averaged in blocks. Finds the suns and the hash.
/// Rotation in degrees about +Y, counter-clockwise seen from above; strength multiplies.
struct MapPlacement {
  double rotation = 0.0, strength = 1.0;
};
RadianceMap make_radiance_map(RadianceMap raw, const MapPlacement& placement, TexelFaults& faults);

/// A line for every fault, naming the map.
std::vector<std::string> warnings_of(const RadianceMap& map, const TexelFaults& faults);

} // namespace meninas
