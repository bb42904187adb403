// Skies by formula, over a ground that reflects a fifth of their light evenly.
//
//   uniform    L = E / pi
//   overcast   L = L_z (1 + 2 sin e) / 3,  E = 7 pi / 9 L_z                           Moon and Spencer 1942, CIE
//   clear      L = L_z f(s) phi(z) / (f(z_s) phi(0)),  f(s) = 0.91 + 10 exp(-3 s) + 0.45 cos^2 s,
//              phi(z) = 1 - exp(-0.32 / cos z)                                         Kittler 1967, CIE 1973
//   preetham   luminance and chromaticities by Perez' formula, by turbidity (preetham.h)
//
// e elevation, z angle from the zenith, s from the sun, z_s the sun's from the zenith; E the
// irradiance of a horizontal plane. CIE skies have no colour: they are white. Their strength is the
// horizontal illuminance in lux, of which 683 make 1 W/m^2 of luminance-weighted light.
#pragma once

#include "scenes/sky/radiance_map.h"

#include <array>
#include <optional>
#include <string_view>

namespace meninas {

enum class SkyKind { uniform, overcast, clear, preetham };

inline constexpr std::array all_sky_kinds{SkyKind::uniform, SkyKind::overcast, SkyKind::clear,
                                          SkyKind::preetham};
std::string_view name_of(SkyKind kind);

/// Whether its light depends on where the sun is, and the sun shines.
bool has_sun(SkyKind kind);

inline constexpr double lux_per_watt = 683.0;
inline constexpr double ground_reflectance = 0.2; ///< a usual one, as of the CIE's daylight factors
inline constexpr double usual_illuminance = 10'000.0; ///< lux: the CIE's overcast sky

struct SkySettings {
  SkyKind kind = SkyKind::overcast;
  Direction sun{0.0, 1.0, 0.0}; ///< towards it, above the horizon where the kind has one
  double turbidity = 3.0;       ///< 2 very clear to 10 hazy
  std::optional<double> illuminance; ///< horizontal, of the sky without its sun, lux; else the usual one, preetham its own
};

/// L above the horizon, before it is scaled to an illuminance: of any size but of preetham's, whose is absolute.
Rgb relative_radiance(const SkySettings& sky, const Direction& d);

struct AnalyticSky {
  RadianceMap map; ///< without suns: there is no disc
  std::optional<DistantSun> sun;
};

/// Placed and scaled, the ground beneath it.
AnalyticSky make_analytic_sky(const SkySettings& sky, const MapPlacement& placement);

/// Irradiance of a horizontal plane under the upper half of a map, W/m^2.
Rgb horizontal_irradiance(const RadianceMap& map);

} // namespace meninas
