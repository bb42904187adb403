// The environment that a user chooses for a scene (a background, a picture or an analytic sky), or else that of
// its file.
//
//   L(d)   W/m^2/sr (scenes/sky/environment.h)
#pragma once

#include "scenes/scene.h"
#include "scenes/sky/analytic_sky.h"
#include "scenes/sky/sun_position.h"

#include <optional>
#include <string>

namespace meninas {

struct EnvironmentChoice {
  std::optional<std::string> file;   ///< an equirectangular picture
  std::optional<SkyKind> sky;
  std::optional<double> rotation;    ///< degrees about +Y, counter-clockwise seen from above
  std::optional<double> strength;    ///< multiplies a picture
  std::optional<SunAngles> sun;      ///< where it stands
  std::optional<GeographicPlace> place;        ///< or where and when it is seen
  std::optional<UtcTime> time;
  std::optional<double> turbidity;
  std::optional<double> illuminance; ///< of an analytic sky, lux

  bool operator==(const EnvironmentChoice&) const = default;
};

/// Puts the scene under what was asked for; warnings go into the scene. Throws InputError of the
/// picture, UsageError of options that do not belong together.
void surround(Scene& scene, const std::optional<Rgb>& background, const EnvironmentChoice& choice);

} // namespace meninas
