#include "scenes/sky/preetham.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

SkyColour preetham_zenith(double turbidity, double sun_zenith_angle) {
  const double t = turbidity, s = sun_zenith_angle;
  const double chi = (4.0 / 9.0 - t / 120.0) * (std::numbers::pi - 2.0 * s);
  const auto cubic = [s](double a, double b, double c, double d) {
    return ((a * s + b) * s + c) * s + d;
  };
  return {(4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
          (cubic(0.00166, -0.00375, 0.00209, 0.0) * t +
           cubic(-0.02903, 0.06377, -0.03202, 0.00394)) *
                  t +
              cubic(0.11693, -0.21196, 0.06052, 0.25886),
          (cubic(0.00275, -0.00610, 0.00317, 0.0) * t +
           cubic(-0.04214, 0.08970, -0.04153, 0.00516)) *
                  t +
              cubic(0.15346, -0.26756, 0.06670, 0.26688)};
}

double PreethamSky::Perez::operator()(double cos_zenith, double from_sun) const {
  const double cos_sun = std::cos(from_sun);
  return over_zenith * (1.0 + a * std::exp(b / cos_zenith)) *
         (1.0 + c * std::exp(d * from_sun) + e * cos_sun * cos_sun);
}

PreethamSky::Perez PreethamSky::perez(const double (&slope)[5], const double (&offset)[5],
                                      double turbidity, double zenith_value,
                                      double sun_zenith_angle) {
  const auto by_turbidity = [&](int k) { return slope[k] * turbidity + offset[k]; };
  Perez f{by_turbidity(0), by_turbidity(1), by_turbidity(2), by_turbidity(3), by_turbidity(4), 1.0};
  f.over_zenith = zenith_value / f(1.0, sun_zenith_angle);
  return f;
}

PreethamSky::PreethamSky(double turbidity, const Direction& sun) : sun_(sun) {
  const double angle = std::atan2(std::hypot(sun.x, sun.z), sun.y);
  const SkyColour zenith = preetham_zenith(turbidity, angle);
  luminance_ = perez({0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
                     {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}, turbidity, zenith.luminance, angle);
  x_ = perez({-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
             {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}, turbidity, zenith.x, angle);
  y_ = perez({-0.0167, -0.0950, -0.0079, -0.0441, -0.0109},
             {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}, turbidity, zenith.y, angle);
}

SkyColour PreethamSky::colour(const Direction& d) const {
  const double cos_zenith = std::max(d.y, 1e-3); // exp(B / cos) is as good as 0 below
  const double from_sun = std::atan2(glm::length(glm::cross(d, sun_)), glm::dot(d, sun_));
  return {luminance_(cos_zenith, from_sun), x_(cos_zenith, from_sun), y_(cos_zenith, from_sun)};
}

Rgb PreethamSky::radiance(const Direction& d) const {
  const SkyColour c = colour(d);
  const double luminance = std::max(0.0, 1000.0 * c.luminance / 683.0);
  const Rgb rgb =
      rec709_of_xyz(luminance * Vec3(c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y));
  return glm::max(rgb, Rgb(0.0));
}

Rgb rec709_of_xyz(const Vec3& xyz) {
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace meninas
