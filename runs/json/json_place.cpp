#include "runs/json/json_place.h"

#include "scenes/errors.h"
#include "scenes/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace meninas {

namespace fs = std::filesystem;

void Place::fail(const std::string& what) const {
  throw InputError(file.string(), pointer.empty() ? "/" : pointer, what);
}

Json parse_json_file(const fs::path& file) {
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

std::string with_hint(const std::string& what, const std::string& name,
                      const std::vector<std::string>& known) {
  const auto nearest = nearest_name(name, known);
  return nearest ? fmt::format("{}, did you mean '{}'?", what, *nearest)
                 : fmt::format("{}, there is {}", what, fmt::join(known, ", "));
}

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
    } else if (value.is_boolean() || value.is_null()) {
      if (value == true) {
        settings.push_back({name, std::nullopt});
      }
    } else if (value.is_array()) {
      if (value.empty())
        place.at(name).fail("is empty");
      for (std::size_t k = 0; k < value.size(); ++k)
        settings.push_back({name, text_at(place.at(name).at(k))});
    } else {
      place.at(name).fail("is neither a text, a list of texts, a number nor true or false");
    }
  }
  return settings;
}

void fail_settings(const Place& place, const std::vector<Setting>& settings,
                   const std::string& what) {
  for (const Setting& setting : settings) {
    if (const std::string prefix = setting.name + ": ";
        what.starts_with(prefix) && place.json.contains(setting.name)) {
      place.at(setting.name).fail(what.substr(prefix.size()));
    }
  }
  place.fail(what);
}

} // namespace meninas
