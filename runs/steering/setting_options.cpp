#include "runs/steering/setting_options.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace meninas {

const char* name_of(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return "draft";
  case Quality::normal:
    return "normal";
  case Quality::fine:
    return "fine";
  }
  return "";
}

const char* name_of(DiffuseTerm term) {
  switch (term) {
  case DiffuseTerm::interpolated:
    return "interpolated";
  case DiffuseTerm::direct:
    return "direct";
  case DiffuseTerm::gather:
    return "gather";
  }
  return "";
}

const char* name_of(FormFactorMethod method) {
  switch (method) {
  case FormFactorMethod::rays:
    return "rays";
  case FormFactorMethod::hemicube:
    return "hemicube";
  case FormFactorMethod::analytic:
    return "analytic";
  }
  return "";
}

const char* name_of(Interpolation method) {
  return method == Interpolation::average ? "average" : "gather";
}

const char* name_of(Projection projection) {
  switch (projection) {
  case Projection::perspective:
    return "perspective";
  case Projection::orthographic:
    return "orthographic";
  case Projection::equirectangular:
    return "equirectangular";
  case Projection::cube:
    return "cube";
  }
  return "";
}

/// What surrounds the scene.
static void add_sky(const EnvironmentChoice& sky, std::vector<std::string>& options) {
  const auto add = [&](const char* option, const std::string& value) {
    options.emplace_back(option);
    options.push_back(value);
  };
  const auto add_given = [&](const char* option, const auto& value) {
    if (value)
      add(option, fmt::format("{}", *value));
  };
  add_given("--environment", sky.file);
  if (sky.sky)
    add("--sky", std::string(name_of(*sky.sky)));
  add_given("--environment-rotation", sky.rotation);
  add_given("--environment-strength", sky.strength);
  if (sky.sun)
    add("--sun", fmt::format("{},{}", sky.sun->azimuth, sky.sun->elevation));
  if (sky.place)
    add("--place", fmt::format("{},{}", sky.place->latitude, sky.place->longitude));
  if (sky.time) {
    const auto seconds = static_cast<int>(std::lround(3600.0 * sky.time->hours));
    // Hours beyond midnight are those of an offset: the same moment, said in Universal Time.
    using namespace std::chrono;
    const sys_days day = year(sky.time->year) / month(static_cast<unsigned>(sky.time->month)) /
                         std::chrono::day(static_cast<unsigned>(sky.time->day));
    const sys_seconds moment = day + std::chrono::seconds(seconds);
    const auto whole = floor<days>(moment);
    const year_month_day date(whole);
    const hh_mm_ss clock(moment - whole);
    add("--date", fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", int(date.year()),
                              unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                              clock.minutes().count(), clock.seconds().count()));
  }
  add_given("--turbidity", sky.turbidity);
  add_given("--sky-illuminance", sky.illuminance);
}

/// What numbers of the file's light stand for.
static void add_units(const SceneState& state, std::vector<std::string>& options) {
  const SceneState standard;
  const auto add = [&](const char* option, std::string value) {
    options.emplace_back(option);
    options.push_back(std::move(value));
  };
  if (state.light_scale != standard.light_scale)
    add("--light-scale", fmt::format("{}", state.light_scale));
  if (state.units)
    add("--units", *state.units == LightUnits::photometric ? "photometric" : "radiometric");
  if (state.luminous_efficacy != standard.luminous_efficacy)
    add("--luminous-efficacy", fmt::format("{}", state.luminous_efficacy));
  for (const auto& [light, file] : state.luminaires)
    add("--ies", fmt::format("{}={}", light, file));
}

std::vector<std::string> options_of(const RunSettings& settings) {
  const RunSettings standard;
  std::vector<std::string> options;
  const auto add = [&](const char* option, std::string value) {
    options.emplace_back(option);
    if (!value.empty())
      options.push_back(std::move(value));
  };
  const auto add_given = [&](const char* option, const auto& value) {
    if (value)
      add(option,
          fmt::format("{}", *value)); // the shortest text that reads back as the same number
  };
  if (settings.quality != standard.quality)
    add("--quality", name_of(settings.quality));
  add_given("--variant", settings.gltf.state.variant);
  add_given("--at", settings.gltf.state.at);
  add_units(settings.gltf.state, options);
  if (settings.projection)
    add("--projection", name_of(*settings.projection));
  if (settings.background)
    add("--background", fmt::format("{},{},{}", settings.background->r, settings.background->g,
                                    settings.background->b));
  add_sky(settings.environment, options);
  add_given("--element-size", settings.element_size);
  add_given("--elements", settings.elements);
  RunSettings unchosen = settings;
  unchosen.mesh.reset();
  if (mesh_cut(settings) != mesh_cut(unchosen))
    add("--mesh", name_of(mesh_cut(settings)));
  add_given("--bends", settings.bends);
  if (settings.form_factors != standard.form_factors)
    add("--form-factors", name_of(settings.form_factors));
  add_given("--rays", settings.rays);
  add_given("--hemicube-resolution", settings.hemicube_resolution);
  if (settings.solver != standard.solver)
    add("--solver", name_of(settings.solver));
  add_given("--tolerance", settings.tolerance);
  add_given("--steps", settings.steps);
  add_given("--link-error", settings.link_error);
  add_given("--mirror-depth", settings.mirror_depth);
  if (settings.interpolation)
    add("--interpolation", name_of(*settings.interpolation));
  if (settings.mode == PictureMode::radiosity)
    add("--mode", "radiosity");
  RunSettings by_preset = settings;
  by_preset.diffuse.reset();
  if (diffuse_term(settings) != diffuse_term(by_preset))
    add("--diffuse", name_of(diffuse_term(settings)));
  add_given("--samples", settings.samples);
  if (settings.filter != standard.filter)
    add("--filter", std::string(name_of(settings.filter)));
  add_given("--pixel-error", settings.pixel_error);
  add_given("--glossy-samples", settings.glossy_samples);
  if (settings.seed != standard.seed)
    add("--seed", fmt::format("{}", settings.seed));
  return options;
}

} // namespace meninas
