#include "runs/environment_choice.h"

#include "image/image_file.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {

namespace {

[[noreturn]] void refuse(const char* option, const std::string& why) {
  throw UsageError(option, why);
}

/// Options that say something of what is not there.
void check_company(const std::optional<Rgb>& background, const EnvironmentChoice& choice) {
  if (choice.file && choice.sky)
    refuse("--sky", "there is --environment already: one sky surrounds a scene");
  if (background && (choice.file || choice.sky))
    refuse("--background",
           fmt::format("there is {} already: one sky surrounds a scene",
                       choice.file ? "--environment" : "--sky"));
  if (choice.strength && !choice.file)
    refuse("--environment-strength", "needs --environment FILE; a sky has --sky-illuminance LUX");
  if (choice.rotation && !choice.file && !choice.sky)
    refuse("--environment-rotation", "needs --environment FILE or --sky");
  const auto needs_sky = [&](const char* option, bool given) {
    if (given && !choice.sky)
      refuse(option, "needs --sky");
  };
  needs_sky("--sun", choice.sun.has_value());
  needs_sky("--place", choice.place.has_value());
  needs_sky("--date", choice.time.has_value());
  needs_sky("--turbidity", choice.turbidity.has_value());
  needs_sky("--sky-illuminance", choice.illuminance.has_value());
  if (choice.place.has_value() != choice.time.has_value())
    refuse(choice.place ? "--place" : "--date",
           "the sun is found by --place LAT,LON and --date TIME together");
  if (choice.sun && choice.place)
    refuse("--sun", "--place and --date say already where the sun is");
}

SunAngles sun_of(const EnvironmentChoice& choice, SkyKind kind) {
  if (!has_sun(kind)) {
    if (choice.sun || choice.place)
      refuse(choice.sun ? "--sun" : "--place",
             fmt::format("no sun shines in --sky {}", name_of(kind)));
    if (choice.turbidity)
      refuse("--turbidity", fmt::format("--sky {} does not depend on it", name_of(kind)));
    return {};
  }
  if (!choice.sun && !choice.place)
    refuse("--sky", fmt::format("{} needs --sun AZIMUTH,ELEVATION, or --place LAT,LON and --date TIME",
                                name_of(kind)));
  const SunAngles sun = choice.sun ? *choice.sun : sun_angles(*choice.place, *choice.time);
  if (!(sun.elevation > 0.0))
    refuse(choice.sun ? "--sun" : "--date",
           fmt::format("the sun is {:.1f} degrees below the horizon: these skies are of the day",
                       -sun.elevation));
  return sun;
}

void put_under_sky(Scene& scene, const EnvironmentChoice& choice) {
  const SunAngles sun = sun_of(choice, *choice.sky);
  AnalyticSky made = make_analytic_sky({.kind = *choice.sky,
                                        .sun = direction_of(sun),
                                        .turbidity = choice.turbidity.value_or(SkySettings{}.turbidity),
                                        .illuminance = choice.illuminance},
                                       {.rotation = choice.rotation.value_or(0.0)});
  if (made.sun) {
    made.map.name += fmt::format(" with the sun at azimuth {:.1f}, elevation {:.1f} degrees",
                                 sun.azimuth, sun.elevation);
    scene.lights.push_back({.name = "sun",
                            .kind = PunctualKind::directional,
                            .intensity = made.sun->irradiance,
                            .direction = -made.sun->towards});
  }
  scene.background = Rgb(0.0);
  scene.background.map = std::make_shared<const RadianceMap>(std::move(made.map));
}

void put_in_picture(Scene& scene, const EnvironmentChoice& choice) {
  ImageFile file = read_image(*choice.file);
  const auto warn = [&](const std::string& what) {
    scene.warnings.push_back(fmt::format("{}: {}", *choice.file, what));
  };
  if (file.picture.width != 2 * file.picture.height)
    warn(fmt::format("{} x {} pixels, not twice as wide as high: it is stretched over the sphere",
                     file.picture.width, file.picture.height));
  if (file.encoding == Encoding::srgb)
    warn("a display picture: white is read as 1 W/m^2/sr, so the sun is clipped");
  RadianceMap raw;
  raw.name = *choice.file;
  raw.width = file.picture.width;
  raw.height = file.picture.height;
  raw.texels = std::move(file.picture.pixels);
  TexelFaults faults;
  auto map = std::make_shared<const RadianceMap>(make_radiance_map(
      std::move(raw),
      {.rotation = choice.rotation.value_or(0.0), .strength = choice.strength.value_or(1.0)},
      faults));
  std::ranges::move(warnings_of(*map, faults), std::back_inserter(scene.warnings));
  scene.background = Rgb(0.0);
  if (mean_radiance(*map) == Rgb(0.0))
    warn("is black: no light comes from it");
  else
    scene.background.map = std::move(map);
}

} // namespace

void surround(Scene& scene, const std::optional<Rgb>& background,
              const EnvironmentChoice& choice) {
  check_company(background, choice);
  if (choice.file)
    put_in_picture(scene, choice);
  else if (choice.sky)
    put_under_sky(scene, choice);
  else if (background)
    scene.background = *background;
}

} // namespace meninas
