// Luminaires with measured distributions: EXT_lights_ies, and IES files that take a light's place.
#include "scenes/gltf/accessors.h"
#include "scenes/gltf/stages.h"
#include "scenes/ies/ies_file.h"
#include "scenes/names.h"
#include "scenes/photometry.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas::gltf {

using Profile = std::shared_ptr<const IntensityDistribution>;

LightUnits light_units_of(const Document& document, Findings& findings) {
  if (document.settings.state.units)
    return *document.settings.state.units;
  const Json* asset = find(document.root, "asset");
  const Json* extras = asset ? find(*asset, "extras") : nullptr;
  const Json* said = extras && extras->is_object() ? find(*extras, "light_units") : nullptr;
  if (!said)
    return LightUnits::radiometric;
  const std::string units = said->is_string() ? said->get<std::string>() : said->dump();
  if (units == "photometric") {
    findings.say("light is in cd/m^2, cd and lx, as asset.extras.light_units says");
    return LightUnits::photometric;
  }
  if (units != "radiometric")
    findings.say(fmt::format("asset.extras.light_units is neither 'radiometric' nor 'photometric' but '{}': "
                             "light counts as radiometric",
                             excerpt(units)));
  return LightUnits::radiometric;
}

/// `where` is the profile's place in the file, if it has no file of its own.
static Profile profile_of(const Resource& resource, const std::string& file,
                          const std::string& where) {
  if (!resource.problem.empty())
    throw UserError(resource.kind, file, where, resource.problem);
  const std::string_view text(reinterpret_cast<const char*>(resource.bytes.data()),
                              resource.bytes.size());
  try {
    return std::make_shared<const IntensityDistribution>(parse_ies(text));
  } catch (const IesProblem& problem) {
    throw InputError(file, fmt::format("{}{}line {}", where, where.empty() ? "" : ", ", problem.line),
                     problem.what());
  }
}

/// One of the file's profiles.
static Profile read_profile(const Document& document, std::size_t index) {
  const Json& json = element(document.root, "iesLights", index);
  const std::string where = fmt::format("EXT_lights_ies.lights[{}]", index);
  if (const auto* uri = find(json, "uri")) {
    const auto name = uri->get<std::string>();
    const bool beside = !name.starts_with("data:");
    return profile_of(read_uri(name, document.folder, document.settings), document.file,
                      beside ? fmt::format("{} '{}'", where, excerpt(name)) : where);
  }
  const auto view = index_at(json, "bufferView");
  if (!view)
    throw InputError(document.file, where, "neither uri nor bufferView");
  const auto bytes = view_bytes(document, *view);
  return profile_of({{bytes.begin(), bytes.end()}, ""}, document.file, where);
}

/// Candela by the file's own numbers, whatever other lights are in; W/sr after this.
static Rgb intensity_of(const SceneState& state, const Rgb& colour) {
  return colour * (state.light_scale / state.luminous_efficacy);
}

/// As bright as other lights may be, and no brighter (cameras.cpp).
static void check_brightness(const PunctualLight& light, const std::string& file,
                             const std::string& where) {
  const double most = std::ranges::max(light.distribution->candela);
  if (!glm::all(glm::lessThan(light.intensity * most, Rgb(1e30))))
    throw InputError(file, where, "its candela are too many");
}

std::optional<glm::dmat3> unit_frame(const glm::dmat4& world) {
  const auto unit = [](const Vec3& v) -> std::optional<Vec3> {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? std::optional(v / length) : std::nullopt;
  };
  const auto z = unit(Vec3(world[2]));
  const auto along_x = unit(Vec3(world[0]));
  if (!z || !along_x)
    return std::nullopt;
  const auto x = unit(*along_x - glm::dot(*along_x, *z) * *z);
  if (!x)
    return std::nullopt;
  const Vec3 y = glm::cross(*z, *x);
  return glm::dmat3(*x, glm::dot(y, Vec3(world[1])) < 0.0 ? -y : y, *z);
}

PunctualLight read_luminaire(const Document& document, const Json& use, const std::string& name,
                             Findings& findings) {
  PunctualLight light;
  light.distribution = read_profile(document, *index_at(use, "light"));
  const double multiplier = number_or(use, "multiplier", 1.0);
  const Rgb colour = vec3_or(use, "color", Rgb(1.0));
  if (multiplier < 0.0 || glm::any(glm::lessThan(colour, Rgb(0.0))))
    findings.about("lights of negative intensity are dark", name);
  if (!(multiplier < 1e12))
    throw InputError(document.file, name, "its multiplier is too large");
  light.intensity = intensity_of(document.settings.state, std::max(multiplier, 0.0) *
                                                              glm::clamp(colour, 0.0, 1.0));
  check_brightness(light, document.file, name);
  return light;
}

void put_luminaires(const Document& document, std::span<const LightPlace> places, Scene& scene,
                    Findings& findings) {
  std::vector<std::string> names;
  for (const PunctualLight& light : scene.lights)
    names.push_back(light.name);
  for (const auto& [name, file] : document.settings.state.luminaires) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw UsageError("--ies", unknown_name("light", name, names));
    const auto k = static_cast<std::size_t>(found - names.begin());
    PunctualLight& light = scene.lights[k];
    if (light.kind == PunctualKind::directional)
      throw UsageError("--ies", fmt::format("light '{}' is directional: it has no place", name));
    if (!places[k].aims)
      throw UsageError("--ies", fmt::format("the node of light '{}' is scaled to nothing: it aims nowhere", name));
    light.distribution = profile_of(read_whole_file(file, document.settings.memory_limit), file, "");
    light.kind = PunctualKind::point;
    light.intensity = intensity_of(document.settings.state, places[k].colour);
    check_brightness(light, file, "");
    const double lumens = document.settings.state.light_scale * luminous(1.0, places[k].colour) *
                          luminous_flux(*light.distribution);
    findings.about("IES files say how bright lights are, not the file's intensity and cone",
                   fmt::format("{}, {:.4g} lm", name, lumens));
  }
}

} // namespace meninas::gltf
