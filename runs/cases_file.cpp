#include "runs/cases_file.h"

#include "scenes/errors.h"
#include "scenes/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace meninas {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A value of the file, and where it is.
struct Place {
  const Json& json;
  const fs::path& file;
  std::string pointer; ///< RFC 6901

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file.string(), pointer.empty() ? "/" : pointer, what);
  }
  Place at(const std::string& key) const { return {json.at(key), file, pointer + '/' + key}; }
  Place at(std::size_t k) const { return {json.at(k), file, fmt::format("{}/{}", pointer, k)}; }
};

std::string with_hint(const std::string& what, const std::string& name,
                      const std::vector<std::string>& known) {
  const auto nearest = nearest_name(name, known);
  return nearest ? fmt::format("{}, did you mean '{}'?", what, *nearest)
                 : fmt::format("{}, there is {}", what, fmt::join(known, ", "));
}

/// An object with these keys and no others.
void check_object(const Place& place, const std::vector<std::string>& required,
                  const std::vector<std::string>& optional) {
  if (!place.json.is_object()) {
    place.fail("is not an object");
  }
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  for (const auto& [key, value] : place.json.items()) {
    if (std::ranges::find(known, key) == known.end()) {
      place.at(key).fail(with_hint("unknown key", key, known));
    }
  }
  for (const std::string& key : required) {
    if (!place.json.contains(key)) {
      place.fail(fmt::format("'{}' is missing", key));
    }
  }
}

std::string text_at(const Place& place) {
  if (!place.json.is_string() || place.json.get_ref<const std::string&>().empty()) {
    place.fail("is not a text");
  }
  return place.json.get<std::string>();
}

double number_at(const Place& place) {
  if (!place.json.is_number() || !std::isfinite(place.json.get<double>())) {
    place.fail("is not a number");
  }
  return place.json.get<double>();
}

std::vector<Setting> settings_at(const Place& place) {
  if (!place.json.is_object()) {
    place.fail("is not an object");
  }
  std::vector<Setting> settings;
  for (const auto& [name, value] : place.json.items()) {
    if (value.is_string()) {
      settings.push_back({name, value.get<std::string>()});
    } else if (value.is_number()) {
      settings.push_back({name, value.dump()});
    } else if (value.is_boolean()) {
      if (value.get<bool>()) {
        settings.push_back({name, std::nullopt});
      }
    } else {
      place.at(name).fail("is neither a text, a number nor true or false");
    }
  }
  return settings;
}

/// Says what is wrong with settings at the one it is about.
[[noreturn]] void fail_settings(const Place& place, const std::vector<Setting>& settings,
                                const std::string& what) {
  for (const Setting& setting : settings) {
    if (const std::string prefix = setting.name + ": "; what.starts_with(prefix)) {
      place.at(setting.name).fail(what.substr(prefix.size()));
    }
  }
  place.fail(what);
}

CaseRendering rendering_at(const Place& place, const char* key, const fs::path& scene,
                           const std::vector<Setting>& otherwise, const SettingsParser& parse) {
  const bool given = place.json.contains(key);
  CaseRendering rendering;
  rendering.settings = given ? settings_at(place.at(key)) : otherwise;
  try {
    rendering.request = parse(scene, rendering.settings);
  } catch (const UserError& error) {
    if (!given) {
      place.fail(error.what());
    }
    fail_settings(place.at(key), rendering.settings, error.what());
  }
  return rendering;
}

void read_limits(const Place& place, RegressCase& result) {
  std::vector<std::string> names{"z"};
  for (const Metric metric : all_metrics) {
    names.emplace_back(name_of(metric));
  }
  check_object(place, {}, names);
  for (const auto& [name, value] : place.json.items()) {
    const double limit = number_at(place.at(name));
    if (limit < 0.0) {
      place.at(name).fail("is negative");
    }
    if (name == "z") {
      result.max_z = limit;
      continue;
    }
    const auto* metric = std::ranges::find(all_metrics, name, [](Metric m) { return name_of(m); });
    result.limits.push_back({*metric, limit});
  }
  if (place.json.empty()) {
    place.fail("nothing is limited: the case could not fail");
  }
}

RegressCase case_at(const Place& place, const SettingsParser& parse) {
  check_object(place, {"name", "scene", "reference", "limits"},
               {"settings", "reference-settings", "relmse-epsilon"});
  const fs::path folder = place.file.parent_path();
  RegressCase result;
  result.name = text_at(place.at("name"));
  const bool is_file_name = std::ranges::all_of(result.name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  });
  if (!is_file_name || result.name.front() == '.') {
    place.at("name").fail(
        "has to be a file name of letters, digits, '.', '_' and '-', not beginning with '.'");
  }
  const fs::path scene = folder / text_at(place.at("scene"));
  result.picture = rendering_at(place, "settings", scene, {}, parse);
  result.reference_picture =
      rendering_at(place, "reference-settings", scene, result.picture.settings, parse);
  result.reference = folder / text_at(place.at("reference"));
  if (result.reference.extension() != ".exr") {
    place.at("reference").fail("is not an .exr file");
  }
  read_limits(place.at("limits"), result);
  if (place.json.contains("relmse-epsilon")) {
    result.relmse_epsilon = number_at(place.at("relmse-epsilon"));
    if (result.relmse_epsilon <= 0.0) {
      place.at("relmse-epsilon").fail("is not positive");
    }
  }
  return result;
}

Json parsed(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw InputError(file.string(), "", "no such file");
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || !fs::is_regular_file(file, error)) {
    throw InputError(file.string(), "", "cannot be read");
  }
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& problem) {
    const auto end =
        text.begin() + static_cast<std::ptrdiff_t>(std::min(problem.byte, text.size()));
    throw InputError(file.string(), fmt::format("line {}", 1 + std::count(text.begin(), end, '\n')),
                     "is not JSON");
  }
}

} // namespace

std::vector<RegressCase> read_cases(const fs::path& file, const SettingsParser& parse) {
  const Json json = parsed(file);
  const Place root{json, file, ""};
  check_object(root, {"cases"}, {"$schema"});
  const Place list = root.at("cases");
  if (!list.json.is_array() || list.json.empty()) {
    list.fail("is not a list of cases");
  }
  std::vector<RegressCase> cases;
  std::set<std::string> names;
  for (std::size_t k = 0; k < list.json.size(); ++k) {
    cases.push_back(case_at(list.at(k), parse));
    if (!names.insert(cases.back().name).second) {
      list.at(k).at("name").fail(fmt::format("another case is named '{}'", cases.back().name));
    }
  }
  return cases;
}

} // namespace meninas
