// The environment of the scene: the radiance that arrives from where nothing is met.
//
//   L(d)   W/m^2/sr, linear Rec.709, d the direction from which it comes, as seen from everywhere
//
// It is the same from all directions, or that of a map (radiance_map.h).
#pragma once

#include "scenes/types.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace meninas {

struct RadianceMap;

/// EXT_lights_image_based as a file has it: six encoded faces of a cube (cube_faces.h).
struct ImageBasedLight {
  std::string name;
  std::array<std::vector<std::byte>, 6> faces; ///< +X, -X, +Y, -Y, +Z, -Z
  double intensity = 1.0;
  std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0}; ///< a quaternion, x y z w
};

struct Environment {
  /// The same from everywhere.
  Environment(const Rgb& radiance = Rgb(0.0)) : constant(radiance) {}

  Rgb constant; ///< where there is no map
  std::shared_ptr<const RadianceMap> map;
  std::shared_ptr<const ImageBasedLight> encoded; ///< of the file, until it is decoded to a map
};

/// Whether nothing comes from anywhere.
bool is_dark(const Environment& environment);

/// Whether it is grey from everywhere.
bool is_grey(const Environment& environment);

/// L(d); the direction need not be of unit length.
Rgb radiance_from(const Environment& environment, const Vec3& direction);

/// A hash of all of it.
std::uint64_t content_hash(const Environment& environment);

/// In words, for a user: "a background of 0.4, 0.6, 1 W/m^2/sr"; empty where it is dark.
std::string description(const Environment& environment);

} // namespace meninas
