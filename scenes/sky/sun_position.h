// Where the sun stands, by place and time: NOAA's solar calculator, after Meeus 1998,
// Astronomical Algorithms, chapter 25. Error: below 0.01 degrees for the years 1800 to 2100, the
// refraction of the air (half a degree at the horizon) left out.
//
//   sin e = sin b sin d + cos b cos d cos h     b latitude, d declination, h hour angle
//
// Azimuths are in degrees from north, clockwise: east is 90. North is -Z, east +X, up +Y.
#pragma once

#include "scenes/types.h"

namespace meninas {

struct GeographicPlace {
  double latitude = 0.0;  ///< degrees, north positive
  double longitude = 0.0; ///< degrees, east positive
  bool operator==(const GeographicPlace&) const = default;
};

/// Universal time, in the proleptic Gregorian calendar.
struct UtcTime {
  int year = 2000, month = 1, day = 1;
  double hours = 0.0; ///< since midnight
  bool operator==(const UtcTime&) const = default;
};

/// Degrees.
struct SunAngles {
  double azimuth = 0.0, elevation = 90.0;
  bool operator==(const SunAngles&) const = default;
};

SunAngles sun_angles(const GeographicPlace& place, const UtcTime& time);

/// Towards the sun, in the scene.
Direction direction_of(const SunAngles& angles);

} // namespace meninas
