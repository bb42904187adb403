#include "scenes/sky/analytic_sky.h"

#include "scenes/photometry.h"
#include "scenes/sky/preetham.h"
#include "scenes/sky/sun_light.h"

#include <cmath>
#include <numbers>

namespace meninas {

namespace {

// A third of a degree: the sky is smooth, and bilinear interpolation errs by less than a thousandth
// but for the first degree about the sun.
constexpr int map_width = 1080, map_height = 540;

double clear_by_sun(double from_sun) {
  const double c = std::cos(from_sun);
  return 0.91 + 10.0 * std::exp(-3.0 * from_sun) + 0.45 * c * c;
}

double clear_by_zenith(double cosine) { return 1.0 - std::exp(-0.32 / std::max(cosine, 1e-3)); }

double angle_between(const Direction& a, const Direction& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

std::string_view name_of(SkyKind kind) {
  switch (kind) {
  case SkyKind::uniform:
    return "uniform";
  case SkyKind::overcast:
    return "overcast";
  case SkyKind::clear:
    return "clear";
  case SkyKind::preetham:
    return "preetham";
  }
  return "";
}

bool has_sun(SkyKind kind) { return kind == SkyKind::clear || kind == SkyKind::preetham; }

Rgb relative_radiance(const SkySettings& sky, const Direction& d) {
  switch (sky.kind) {
  case SkyKind::uniform:
    return Rgb(1.0);
  case SkyKind::overcast:
    return Rgb((1.0 + 2.0 * d.y) / 3.0);
  case SkyKind::clear: {
    const double at_zenith = clear_by_sun(angle_between(sky.sun, {0.0, 1.0, 0.0}));
    return Rgb(clear_by_sun(angle_between(sky.sun, d)) * clear_by_zenith(d.y) /
               (at_zenith * clear_by_zenith(1.0)));
  }
  case SkyKind::preetham:
    return PreethamSky(sky.turbidity, sky.sun).radiance(d);
  }
  return Rgb(0.0);
}

/// What the rows above the horizon bring to a horizontal plane, each by its exact cosine.
Rgb horizontal_irradiance(const RadianceMap& map) {
  Rgb sum(0.0);
  for (int j = 0; 2 * j + 1 < map.height; ++j) {
    // Integral of cos sin over the row: (sin^2 b - sin^2 a) / 2 = sin(b - a) sin(b + a) / 2.
    const double half = 0.5 * std::numbers::pi / map.height;
    const double row = 0.5 * std::sin(2.0 * half) * std::sin((4 * j + 2) * half);
    for (int i = 0; i < map.width; ++i)
      sum += 2.0 * std::numbers::pi / map.width * row *
             Rgb(map.texels[static_cast<std::size_t>(j * map.width + i)]);
  }
  return sum;
}

AnalyticSky make_analytic_sky(const SkySettings& sky, const MapPlacement& placement) {
  RadianceMap raw;
  raw.name = std::string(name_of(sky.kind)) + " sky";
  raw.width = map_width;
  raw.height = map_height;
  raw.edge_at_horizon = true;
  raw.texels.assign(static_cast<std::size_t>(map_width) * map_height, glm::vec3(0.0F));
  for (int j = 0; j < map_height / 2; ++j)
    for (int i = 0; i < map_width; ++i)
      raw.texels[static_cast<std::size_t>(j * map_width + i)] = glm::vec3(relative_radiance(
          sky, direction_at(raw, (i + 0.5) / map_width, (j + 0.5) / map_height)));
  Rgb horizontal = horizontal_irradiance(raw);
  const bool absolute = sky.kind == SkyKind::preetham && !sky.illuminance;
  if (!absolute) {
    const double wanted = sky.illuminance.value_or(usual_illuminance) / lux_per_watt;
    const double factor = wanted / luminance_of(glm::vec3(horizontal));
    for (glm::vec3& texel : raw.texels)
      texel *= static_cast<float>(factor);
    horizontal *= factor;
  }

  AnalyticSky made;
  const double zenith_angle = angle_between(sky.sun, {0.0, 1.0, 0.0});
  if (has_sun(sky.kind))
    made.sun = {.towards = sky.sun, .irradiance = sun_irradiance(sky.turbidity, zenith_angle)};
  if (made.sun)
    horizontal += std::cos(zenith_angle) * made.sun->irradiance;
  const glm::vec3 ground(ground_reflectance / std::numbers::pi * horizontal);
  std::fill(raw.texels.begin() + map_height / 2 * map_width, raw.texels.end(), ground);
  TexelFaults none_expected;
  made.map = make_radiance_map(std::move(raw), placement, none_expected);
  if (made.sun)
    made.sun->towards = turned(made.map, made.sun->towards);
  return made;
}

} // namespace meninas
