#include "runs/json/reference_manifest.h"

#include "runs/report/stats.h"
#include "scenes/errors.h"
#include "scenes/version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <ctime>
#include <fstream>

namespace meninas {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json read_manifest(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return Json::object();
  }
  Json manifest = Json::parse(stream, nullptr, false);
  if (!manifest.is_object()) {
    throw InputError(file.string(), "", "is not a manifest: move it away to begin a new one");
  }
  return manifest;
}

/// As somebody would type it in the folder of the cases.
std::string command_of(const RegressCase& regress_case, const fs::path& folder) {
  const auto from_folder = [&](const fs::path& file) {
    return file.lexically_proximate(folder.empty() ? "." : folder).generic_string();
  };
  const CaseRendering& rendering = regress_case.reference_picture;
  std::string command = fmt::format("meninas render {} -o {}", from_folder(rendering.request.scene),
                                    from_folder(regress_case.reference));
  for (const Setting& setting : rendering.settings) {
    command += " --" + setting.name + (setting.value ? ' ' + *setting.value : "");
  }
  return command;
}

Json attribute(const Attributes& attributes, const std::string& key) {
  for (const auto& [name, value] : attributes) {
    if (name == key) {
      return value;
    }
  }
  return nullptr;
}

Json number(const Json& text) {
  if (!text.is_string()) {
    return nullptr;
  }
  return Json::parse(text.get<std::string>(), nullptr, false);
}

} // namespace

void enter_reference(const RegressCase& regress_case, const fs::path& cases_file) {
  const fs::path manifest_file = regress_case.reference.parent_path() / "manifest.json";
  const Attributes header = read_image(regress_case.reference).attributes;
  Json manifest = read_manifest(manifest_file);
  manifest[regress_case.reference.filename().string()] = {
      {"case", regress_case.name},
      {"scene", attribute(header, "scene")},
      {"scene_hash", attribute(header, "sceneHash")},
      {"command", command_of(regress_case, cases_file.parent_path())},
      {"samples", number(attribute(header, "samples"))},
      {"standard_error", number(attribute(header, "standardError"))},
      {"program", fmt::format("meninas {}", program_version())},
      {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
  // Sorted by file, so that a manifest does not depend on the order of updates.
  const nlohmann::json sorted = manifest;
  Json ordered = Json::object();
  for (const auto& [file, entry] : sorted.items()) {
    ordered[file] = manifest[file];
  }
  write_text_file(manifest_file, ordered.dump(2) + '\n');
}

} // namespace meninas
