// The jobs of a batch, as a JSON file (schema:
// docs/batch.schema.json, which the program carries and checks against):
//
//   {"defaults": {"settings": {"quality": "draft", "size": "320x240"}},
//    "jobs": [{"scenes": "rooms/*.glb", "cameras": "*", "modes":
//    ["radiosity", "hybrid"], "outputs": ["{scene}/{camera}-{mode}.png"]},
//             {"scenes": "hall.glb", "cameras": {"orbit": {"radius":
//             2}, "frames": 36}, "settings": {"samples": 64}}]}
//
// A job stands for one picture for each of its scenes, times of its animations, cameras (or frames
// of a path) and modes; the frames of a path and the times of a job go side by side.
// Members that a job leaves out have the values of the defaults; settings,
// which have the names and values of the options of `meninas render`, are merged one by one.
#pragma once

#include "runs/batch/camera_path.h"
#include "runs/steering/setting.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meninas {

/// The scene's first camera, those whose names match a text, or a path.
using CameraChoice = std::variant<std::monostate, std::string, CameraPath>;

/// The settings for the pictures of a job in one of its modes.
struct JobMode {
  std::string name;              ///< radiosity, hybrid, reference
  RenderRequest request;         ///< without scene, camera and outputs
  std::vector<Setting> settings; ///< what the request was made of, `mode` among them
  std::uint64_t environment = 0; ///< a hash of the picture of the surroundings, if there is one
};

struct BatchJob {
  std::string name;
  std::string place;                         ///< in the file, RFC 6901
  std::vector<std::filesystem::path> scenes; ///< as written: files and patterns
  std::vector<double> times; ///< of the scenes' animations, seconds; none: the state of the settings
  std::vector<CameraChoice> cameras;
  std::vector<JobMode> modes;
  std::vector<std::string> outputs; ///< templates
};

/// Throws InputError with the JSON pointer of what is wrong; no scene is looked at.
std::vector<BatchJob> read_batch(const std::filesystem::path& file, const SettingsParser& parse);

/// The schema's text.
std::string_view batch_schema();
/// The schema with these options as settings of a job, so that editors know them too.
std::string batch_schema(std::span<const SettingHelp> settings);

} // namespace meninas
