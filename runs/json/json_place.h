// JSON files that people write:
// values with the place they stand at, so that every complaint names it.
#pragma once

#include "runs/steering/setting.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace meninas {

/// Keeps the order in which keys are written.
using Json = nlohmann::ordered_json;

/// A value of the file, and where it is. Neither is owned.
struct Place {
  const Json& json;
  const std::filesystem::path& file;
  std::string pointer; ///< RFC 6901

  /// Throws InputError `FILE: POINTER: WHAT`.
  [[noreturn]] void fail(const std::string& what) const;
  Place at(const std::string& key) const { return {json.at(key), file, pointer + '/' + key}; }
  Place at(std::size_t k) const { return {json.at(k), file, pointer + '/' + std::to_string(k)}; }
};

/// Throws InputError, with the line for what is not JSON.
Json parse_json_file(const std::filesystem::path& file);

/// "WHAT, did you mean 'x'?", or what there is.
std::string with_hint(const std::string& what, const std::string& name,
                      const std::vector<std::string>& known);

/// Checks that it is an object with all of the required keys,
/// any of the optional ones, and no others.
void check_object(const Place& place, const std::vector<std::string>& required,
                  const std::vector<std::string>& optional);

std::string text_at(const Place& place); ///< not empty
double number_at(const Place& place);    ///< finite

/// An object of options: texts and numbers are values, lists the values of an option that may be given several
/// times, true is a flag;
/// false and null are options not given.
std::vector<Setting> settings_at(const Place& place);

/// Says what the parser has found wrong with settings, at the one it is about if it stands here.
[[noreturn]] void fail_settings(const Place& place, const std::vector<Setting>& settings,
                                const std::string& what);

} // namespace meninas
