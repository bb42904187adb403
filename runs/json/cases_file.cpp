#include "runs/json/cases_file.h"

#include "runs/json/json_place.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace meninas {
namespace {

namespace fs = std::filesystem;

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

} // namespace

std::vector<RegressCase> read_cases(const fs::path& file, const SettingsParser& parse) {
  const Json json = parse_json_file(file);
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
