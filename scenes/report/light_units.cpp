#include "scenes/report/light_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

static double largest_of(const Rgb& colour) { return std::max({colour.r, colour.g, colour.b}); }

/// Steradians.
static double solid_angle(const PunctualLight& light) {
  const double cosine = light.kind == PunctualKind::spot ? std::cos(light.outer_cone) : -1.0;
  return 2.0 * std::numbers::pi * (1.0 - cosine);
}

/// Watts, of point and spot lights. Measured luminaires have the unit of their files.
static double power_of_lights(const Scene& scene) {
  double power = 0.0;
  for (const PunctualLight& light : scene.lights)
    if (light.kind != PunctualKind::directional && !light.distribution)
      power += solid_angle(light) * largest_of(light.intensity);
  return power;
}

std::optional<std::string> describe_mixed_units(const Scene& scene) {
  constexpr double too_bright = 100.0;      // W/m^2
  constexpr double lumens_per_watt = 683.0; // of green light, by the definition of the candela
  double brightest = 0.0, area = 0.0;
  for (const Material& material : scene.materials)
    brightest = std::max(brightest, largest_of(material.emission));
  const double power = power_of_lights(scene);
  if (brightest == 0.0 || power == 0.0)
    return std::nullopt;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    area += glm::length(area_vector(corners(scene, TriangleId{t})));
  const double irradiance = power / area;
  if (!(irradiance > too_bright && irradiance > std::numbers::pi * brightest))
    return std::nullopt;
  return fmt::format(
      "point and spot lights are out of proportion with what glows: about {:.2g} W/m^2 beside "
      "{:.2g} W/m^2/sr; if the exporter wrote candela for them, --light-scale {:.4g} undoes it",
      irradiance, brightest, 1.0 / lumens_per_watt);
}

} // namespace meninas
