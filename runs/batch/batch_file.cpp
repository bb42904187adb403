#include "runs/batch/batch_file.h"

#include "runs/batch/output_name.h"
#include "runs/json/json_place.h"
#include "runs/json/json_schema.h"
#include "runs/pages/batch_schema_text.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meninas {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;

double number_or(const Json& json, const char* key, double otherwise) {
  return json.contains(key) ? json.at(key).get<double>() : otherwise;
}

Vec3 vector_of(const Json& json) { return {json[0].get<double>(), json[1], json[2]}; }

std::optional<double> angle_of_view(const Json& json) {
  return json.contains("fov") ? std::optional(degrees * json["fov"].get<double>()) : std::nullopt;
}

Orbit orbit_of(const Json& json) {
  Orbit orbit{.centre = std::nullopt,
              .radius = json["radius"].get<double>(),
              .height = number_or(json, "height", 0.0)};
  if (json.contains("centre")) {
    orbit.centre = vector_of(json["centre"]);
  }
  const double from = number_or(json, "from", 0.0);
  orbit.from = degrees * from;
  orbit.to = degrees * number_or(json, "to", from + 360.0);
  return orbit;
}

std::vector<Pose> poses_at(const Place& place) {
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < place.json.size(); ++k) {
    const Json& json = place.json[k];
    poses.push_back({vector_of(json["position"]), vector_of(json["target"]), angle_of_view(json),
                     number_or(json, "at", static_cast<double>(k))});
    if (poses[k].position == poses[k].target) {
      place.at(k).fail("looks at its own position");
    }
    if (k > 0 && !(poses[k].at > poses[k - 1].at)) {
      place.at(k).fail(fmt::format("its time {} is not after that of the pose before, {}",
                                   poses[k].at, poses[k - 1].at));
    }
  }
  return poses;
}

CameraChoice camera_at(const Place& place) {
  const Json& json = place.json;
  if (json.is_string()) {
    return json.get<std::string>();
  }
  const bool orbit = json.contains("orbit");
  CameraPath path;
  path.name = json.value("name", orbit ? "orbit" : "poses");
  if (orbit) {
    path.shape = orbit_of(json["orbit"]);
  } else {
    path.shape = poses_at(place.at("poses"));
  }
  if (json.contains("frames")) {
    path.frames = json["frames"].get<int>();
  }
  path.vertical_fov = angle_of_view(json).value_or(path.vertical_fov);
  return path;
}

/// From, and then every 1 / fps until beyond `to`; or a list.
std::vector<double> times_at(const Place& place) {
  const Json& json = place.json;
  if (json.is_array()) {
    return json.get<std::vector<double>>();
  }
  const double from = number_or(json, "from", 0.0), to = json["to"], fps = json["fps"];
  if (!(to >= from)) {
    place.fail(fmt::format("ends at {}, before it begins at {}", to, from));
  }
  // Ends that are whole frames in decimals are a hair before or after in binary.
  constexpr double hair = 1e-6, most = 1e6;
  const double last = std::floor((to - from) * fps + hair);
  if (!(last < most)) {
    place.fail(fmt::format("asks for {:.3g} frames, more than {:.0f}", last + 1.0, most));
  }
  std::vector<double> times;
  for (int frame = 0; frame <= static_cast<int>(last); ++frame) {
    times.push_back(from + frame / fps);
  }
  return times;
}

/// As many as cameras_along() will give.
std::size_t frames_of(const CameraPath& path) {
  const auto* poses = std::get_if<std::vector<Pose>>(&path.shape);
  return path.frames || !poses ? static_cast<std::size_t>(path.frames.value_or(1)) : poses->size();
}

/// A job's own value, else the default, with the place it stands at;
/// nothing where neither says anything.
std::optional<Place> chosen(const Place& job, const std::optional<Place>& defaults,
                            const std::string& key) {
  if (job.json.contains(key)) {
    return job.at(key);
  }
  return defaults && defaults->json.contains(key) ? std::optional<Place>(defaults->at(key))
                                                  : std::nullopt;
}

/// What may be one or a list of several.
template <typename Take>
void for_each_of(const Place& place, Take take) {
  if (!place.json.is_array()) {
    take(place);
    return;
  }
  for (std::size_t k = 0; k < place.json.size(); ++k) {
    take(place.at(k));
  }
}

/// The defaults' settings, overridden one by one; null takes one away.
Json merged_settings(const Place& job, const std::optional<Place>& defaults) {
  Json settings = Json::object();
  for (const Place* level : {defaults ? &*defaults : nullptr, &job}) {
    if (level == nullptr || !level->json.contains("settings")) {
      continue;
    }
    const Place own = level->at("settings");
    for (const char* elsewhere : {"camera", "mode"}) {
      if (own.json.contains(elsewhere)) {
        own.at(elsewhere).fail(fmt::format("is no setting here but the job's '{}s'", elsewhere));
      }
    }
    settings.merge_patch(own.json);
  }
  if (settings.contains("at") && chosen(job, defaults, "at")) {
    const bool own = job.json.contains("settings") && job.json["settings"].contains("at");
    (own ? job : *defaults).at("settings").at("at").fail("the job has an 'at' of its own");
  }
  return settings;
}

/// Blames the job's own settings for what they say, the defaults' for the rest.
[[noreturn]] void blame(const Place& job, const std::optional<Place>& defaults,
                        const std::vector<Setting>& settings, const std::string& what) {
  const std::string name = what.substr(0, what.find(':'));
  for (const Place* level : {&job, defaults ? &*defaults : nullptr}) {
    if (level != nullptr && level->json.contains("settings") &&
        level->json["settings"].contains(name)) {
      fail_settings(level->at("settings"), settings, what);
    }
  }
  job.fail(what);
}

JobMode mode_of(const std::string& name, const Place& job, const std::optional<Place>& defaults,
                const Json& merged, const SettingsParser& parse) {
  JobMode mode{.name = name, .request = {}, .settings = settings_at({merged, job.file, ""})};
  mode.settings.push_back({"mode", name});
  try {
    mode.request = parse({}, mode.settings);
    if (auto& picture = mode.request.settings.environment.file) {
      picture = (job.file.parent_path() / *picture).string();
      mode.environment = hash_of_file(*picture);
    }
    for (auto& [light, file] : mode.request.settings.gltf.state.luminaires)
      file = (job.file.parent_path() / file).string();
  } catch (const UserError& error) {
    blame(job, defaults, mode.settings, error.what());
  }
  return mode;
}

/// The check is not in the schema: a template may come from the defaults while the job has paths.
void read_outputs(const std::optional<Place>& outputs, BatchJob& job) {
  if (!outputs) {
    job.outputs = {"{scene}-{camera}-{mode}-{frame}.exr"};
    return;
  }
  for_each_of(*outputs, [&](const Place& place) {
    job.outputs.push_back(place.json.get<std::string>());
    if (const auto problem = template_problem(job.outputs.back())) {
      place.fail(*problem);
    }
  });
}

/// A path goes side by side with the scene's animations.
void check_frames(const Place& camera, const BatchJob& job) {
  const auto* path = std::get_if<CameraPath>(&job.cameras.back());
  if (path && !job.times.empty() && frames_of(*path) != job.times.size()) {
    camera.fail(fmt::format("has {} frames, but 'at' has {}: a path and the scene's animations go "
                            "side by side",
                            frames_of(*path), job.times.size()));
  }
}

BatchJob job_at(const Place& place, const std::optional<Place>& defaults, std::size_t number,
                const SettingsParser& parse) {
  BatchJob job{.name = place.json.value("name", std::to_string(number)),
               .place = place.pointer,
               .scenes = {},
               .times = {},
               .cameras = {},
               .modes = {},
               .outputs = {}};
  if (const auto times = chosen(place, defaults, "at")) {
    job.times = times_at(*times);
  }
  const auto scenes = chosen(place, defaults, "scenes");
  if (!scenes) {
    place.fail("'scenes' is missing, here and in the defaults");
  }
  for_each_of(*scenes, [&](const Place& scene) {
    job.scenes.push_back(place.file.parent_path() / scene.json.get<std::string>());
  });
  if (const auto cameras = chosen(place, defaults, "cameras")) {
    for_each_of(*cameras, [&](const Place& camera) {
      job.cameras.push_back(camera_at(camera));
      check_frames(camera, job);
    });
  } else {
    job.cameras.emplace_back();
  }
  const Json settings = merged_settings(place, defaults);
  std::set<std::string> modes;
  const auto add_mode = [&](const std::string& name) {
    if (modes.insert(name).second) {
      job.modes.push_back(mode_of(name, place, defaults, settings, parse));
    }
  };
  if (const auto chosen_modes = chosen(place, defaults, "modes")) {
    for_each_of(*chosen_modes, [&](const Place& mode) { add_mode(mode.json); });
  } else {
    add_mode("hybrid");
  }
  read_outputs(chosen(place, defaults, "outputs"), job);
  return job;
}

} // namespace

std::string_view batch_schema() { return batch_schema_text; }

std::string batch_schema(std::span<const SettingHelp> settings) {
  auto schema = Json::parse(batch_schema());
  auto& properties = schema["$defs"]["settings"]["properties"];
  for (const SettingHelp& setting : settings) {
    if (setting.name == "camera" || setting.name == "mode") {
      continue; // a job has them itself
    }
    Json property{{"description", setting.description}};
    if (setting.takes.empty()) {
      property["type"] = {"boolean", "null"};
    } else if (setting.takes.starts_with('[')) {
      property["type"] = {"boolean", "string", "number", "null"};
    } else if (setting.takes.find('|') != std::string::npos) {
      property["enum"] = Json::array();
      std::string_view names = setting.takes;
      for (auto bar = names.find('|'); !names.empty(); bar = names.find('|')) {
        property["enum"].push_back(std::string(names.substr(0, bar)));
        names.remove_prefix(bar == std::string_view::npos ? names.size() : bar + 1);
      }
      property["enum"].push_back(nullptr);
    } else if (setting.repeatable) {
      property["anyOf"] = {{{"type", {"string", "null"}}}, {{"$ref", "#/$defs/texts"}}};
    } else {
      property["type"] = {"string", "number", "null"};
    }
    properties[setting.name] = property;
  }
  return schema.dump(2) + '\n';
}

std::vector<BatchJob> read_batch(const std::filesystem::path& file, const SettingsParser& parse) {
  const Json json = parse_json_file(file);
  const Place root{json, file, ""};
  check_schema(root, Json::parse(batch_schema()));
  const auto defaults =
      json.contains("defaults") ? std::optional<Place>(root.at("defaults")) : std::nullopt;
  const Place list = root.at("jobs");
  std::vector<BatchJob> jobs;
  for (std::size_t k = 0; k < list.json.size(); ++k) {
    jobs.push_back(job_at(list.at(k), defaults, k, parse));
  }
  return jobs;
}

} // namespace meninas
