#include "scenes/sky/sun_position.h"

#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Days since noon of 1 January 2000, the Julian date 2451545.
double days_since_2000(const UtcTime& time) {
  // Of the Gregorian calendar, whose years begin in March here (Fliegel, van Flandern 1968).
  const int shift = (time.month - 14) / 12;
  const int number = 1461 * (time.year + 4800 + shift) / 4 +
                     367 * (time.month - 2 - 12 * shift) / 12 -
                     3 * ((time.year + 4900 + shift) / 100) / 4 + time.day - 32075;
  return number - 2451545 + (time.hours - 12.0) / 24.0;
}

/// Where the sun stands among the stars, radians, and how far sundials are ahead, in minutes.
struct SunOfDate {
  double declination, equation_of_time;
};

SunOfDate sun_of(double centuries) {
  const double t = centuries;
  const double mean_longitude = (280.46646 + t * (36000.76983 + 0.0003032 * t)) * degree;
  const double anomaly = (357.52911 + t * (35999.05029 - 0.0001537 * t)) * degree;
  const double eccentricity = 0.016708634 - t * (0.000042037 + 0.0000001267 * t);
  const double centre = std::sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) +
                        std::sin(2.0 * anomaly) * (0.019993 - 0.000101 * t) +
                        std::sin(3.0 * anomaly) * 0.000289;
  const double node = (125.04 - 1934.136 * t) * degree;
  const double longitude =
      mean_longitude + (centre - 0.00569 - 0.00478 * std::sin(node)) * degree;
  const double obliquity =
      (23.0 +
       (26.0 + (21.448 - t * (46.8150 + t * (0.00059 - 0.001813 * t))) / 60.0) / 60.0 +
       0.00256 * std::cos(node)) *
      degree;
  const double half = std::tan(0.5 * obliquity), y = half * half, e = eccentricity;
  const double ahead = y * std::sin(2.0 * mean_longitude) - 2.0 * e * std::sin(anomaly) +
                       4.0 * e * y * std::sin(anomaly) * std::cos(2.0 * mean_longitude) -
                       0.5 * y * y * std::sin(4.0 * mean_longitude) -
                       1.25 * e * e * std::sin(2.0 * anomaly);
  return {std::asin(std::sin(obliquity) * std::sin(longitude)), 4.0 * ahead / degree};
}

} // namespace

SunAngles sun_angles(const GeographicPlace& place, const UtcTime& time) {
  const SunOfDate sun = sun_of(days_since_2000(time) / 36525.0);
  const double minutes = 60.0 * time.hours + sun.equation_of_time + 4.0 * place.longitude;
  const double hour_angle = (minutes / 4.0 - 180.0) * degree;
  const double latitude = place.latitude * degree;
  const double up = std::sin(latitude) * std::sin(sun.declination) +
                    std::cos(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
  const double east = -std::cos(sun.declination) * std::sin(hour_angle);
  const double north = std::cos(latitude) * std::sin(sun.declination) -
                       std::sin(latitude) * std::cos(sun.declination) * std::cos(hour_angle);
  double azimuth = std::atan2(east, north) / degree;
  if (azimuth < 0.0)
    azimuth += 360.0;
  return {azimuth, std::atan2(up, std::hypot(east, north)) / degree};
}

Direction direction_of(const SunAngles& angles) {
  const double azimuth = angles.azimuth * degree, elevation = angles.elevation * degree;
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          -std::cos(elevation) * std::cos(azimuth)};
}

} // namespace meninas
