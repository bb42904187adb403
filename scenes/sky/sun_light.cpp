#include "scenes/sky/sun_light.h"

#include "scenes/sky/preetham.h"

#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double first_wavelength = 380.0, step = 10.0; // nm
constexpr double sun_solid_angle = 6.80e-5;             // of a disc of 0.533 degrees

/// Radiance of the sun outside the air, W/m^2/sr/nm, and absorption by a centimetre of ozone.
struct SolarSample {
  double radiance, ozone;
};
constexpr SolarSample solar[] = {
    {16559.0, 0.0},   {16233.7, 0.0},   {21127.5, 0.0},   {25888.2, 0.0},   {25829.1, 0.0},
    {24232.3, 0.0},   {26760.5, 0.0},   {29658.3, 0.003}, {30545.4, 0.006}, {30057.5, 0.009},
    {30663.7, 0.014}, {28830.4, 0.021}, {28712.1, 0.030}, {27825.0, 0.040}, {27100.6, 0.048},
    {27233.6, 0.063}, {26361.3, 0.075}, {25503.8, 0.085}, {25060.2, 0.103}, {25311.6, 0.120},
    {25355.9, 0.120}, {25134.2, 0.115}, {24631.5, 0.125}, {24173.2, 0.120}, {23685.3, 0.105},
    {23212.1, 0.090}, {22827.7, 0.079}, {22339.8, 0.067}, {21970.2, 0.057}, {21526.7, 0.048},
    {21097.9, 0.036}, {20728.3, 0.028}, {20240.4, 0.023}, {19870.8, 0.018}, {19427.2, 0.014},
    {19072.4, 0.011}, {18628.9, 0.010}, {18259.2, 0.009}};

double lobe(double wavelength, double centre, double below, double above) {
  const double t = (wavelength - centre) / (wavelength < centre ? below : above);
  return std::exp(-0.5 * t * t);
}

/// CIE 1931.
Vec3 colour_matching(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

} // namespace

Rgb sun_irradiance(double turbidity, double zenith_angle) {
  if (zenith_angle >= 0.5 * std::numbers::pi)
    return Rgb(0.0);
  const double degrees = zenith_angle / std::numbers::pi * 180.0;
  const double mass = 1.0 / (std::cos(zenith_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double haze = std::max(0.0, 0.04608 * turbidity - 0.04586);
  Vec3 xyz(0.0);
  double nm = first_wavelength;
  for (const SolarSample& sample : solar) {
    const double l = 1e-3 * nm;
    const double depth = 0.008735 * std::pow(l, -4.08) + haze * std::pow(l, -1.3) +
                         0.35 * sample.ozone;
    xyz += sample.radiance * std::exp(-mass * depth) * colour_matching(nm);
    nm += step;
  }
  return glm::max(rec709_of_xyz(sun_solid_angle * step * xyz), Rgb(0.0));
}

} // namespace meninas
