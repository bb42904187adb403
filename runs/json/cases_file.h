// The cases of an image regression suite, as a JSON file (schema: docs/regress.schema.json):
//
//   {"cases": [{"name": "room", "scene": "room.glb", "settings":
//   {"quality": "draft", "size": "96x96"},
//               "reference": "images/room.exr", "reference-settings": {"mode": "reference",
//               "float": true, ...}, "limits": {"relmse": 0.01, "z": 4}, "relmse-epsilon": 0.01}]}
//
// Paths are relative to the file. Settings have the names and values of the options
// of `meninas render`; those of the reference are the same unless stated.
// Whatever is unknown, missing or out of range is an InputError with the JSON pointer of its place.
#pragma once

#include "runs/report/comparison.h"
#include "runs/steering/setting.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

struct CaseRendering {
  RenderRequest request; ///< without outputs
  std::vector<Setting> settings;
};

struct RegressCase {
  std::string name; ///< letters, digits, '.', '_', '-': it becomes a file name
  CaseRendering picture;
  CaseRendering reference_picture; ///< what an update renders
  std::filesystem::path reference; ///< .exr
  std::vector<MetricLimit> limits;
  std::optional<double> max_z; ///< image/z_test.h; needs a reference with a layer `variance`
  double relmse_epsilon = MetricSettings{}.relmse_epsilon;
};

std::vector<RegressCase> read_cases(const std::filesystem::path& file, const SettingsParser& parse);

} // namespace meninas
