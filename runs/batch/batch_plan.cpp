#include "runs/batch/batch_plan.h"

#include "runs/batch/output_name.h"
#include "runs/preparation.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <glob.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>

namespace meninas {
namespace {

namespace fs = std::filesystem;

/// What was found out about a scene file, or why nothing could be.
struct KnownScene {
  std::shared_ptr<const SceneFacts> facts;
  std::optional<BatchProblem> problem;
};
/// A file in a state of its materials, animations and lights is a scene of its own.
using SceneFile = std::pair<fs::path, SceneState>;
using KnownScenes = std::map<SceneFile, KnownScene>;

/// Those of all modes of a job, which share its settings: one for each of its times, or one.
std::vector<SceneState> states_of(const BatchJob& job) {
  const SceneState& state = job.modes.front().request.settings.gltf.state;
  std::vector<SceneState> states(std::max<std::size_t>(1, job.times.size()), state);
  for (std::size_t k = 0; k < job.times.size(); ++k) {
    states[k].at = job.times[k];
  }
  return states;
}

bool is_pattern(const std::string& text) { return text.find_first_of("*?[{") != std::string::npos; }

/// The files that a pattern matches, sorted; a file of that very name is itself.
std::vector<fs::path> matching_files(const fs::path& pattern) {
  std::error_code error;
  if (!is_pattern(pattern.string()) || fs::exists(pattern, error)) {
    return {pattern};
  }
  const auto release = [](glob_t* found) { ::globfree(found); };
  glob_t found{};
  const std::unique_ptr<glob_t, decltype(release)> owner(&found, release);
  std::vector<fs::path> files;
  if (::glob(pattern.c_str(), GLOB_BRACE, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    std::ranges::sort(files);
    files.erase(std::unique(files.begin(), files.end()), files.end());
  }
  return files;
}

/// The files of every pattern of the jobs, looked up once: what appears meanwhile is not there.
using FoundFiles = std::map<fs::path, std::vector<fs::path>>;
FoundFiles find_files(const std::vector<BatchJob>& jobs) {
  FoundFiles found;
  for (const BatchJob& job : jobs) {
    for (const fs::path& pattern : job.scenes) {
      if (!found.contains(pattern)) {
        found.emplace(pattern, matching_files(pattern));
      }
    }
  }
  return found;
}

KnownScenes read_scenes(const FoundFiles& found, const std::vector<BatchJob>& jobs,
                        const GltfSettings& gltf) {
  KnownScenes scenes;
  for (const BatchJob& job : jobs) {
    for (const fs::path& pattern : job.scenes) {
      for (const fs::path& file : found.at(pattern)) {
        for (const SceneState& state : states_of(job)) {
          scenes.emplace(SceneFile{file, state}, KnownScene{});
        }
      }
    }
  }
  std::vector<KnownScenes::value_type*> list;
  for (auto& entry : scenes) {
    list.push_back(&entry);
  }
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t k) {
    auto& [file, known] = *list[k];
    GltfSettings own = gltf;
    own.state = file.second;
    try {
      known.facts = std::make_shared<const SceneFacts>(facts_of(load_gltf(file.first, own)));
    } catch (const UserError& error) {
      known.problem = {error.what(), static_cast<int>(error.code())};
    }
  });
  return scenes;
}

/// A camera of a job in a scene: one, or the frames of a path.
std::vector<Camera> chosen_cameras(const CameraChoice& choice, const Scene& cameras_only,
                                   const Bounds& bounds, const RunSettings& settings) {
  const auto& cameras = cameras_only.cameras;
  if (const auto* path = std::get_if<CameraPath>(&choice)) {
    return cameras_along(*path, bounds);
  }
  const auto* name = std::get_if<std::string>(&choice);
  const auto is_named = [&](const Camera& camera) { return camera.name == *name; };
  if (name == nullptr || (cameras.empty() && *name == "*")) {
    return {cameras.empty() ? default_view(bounds, settings) : cameras.front()};
  }
  if (!is_pattern(*name) || std::ranges::any_of(cameras, is_named)) {
    return {find_camera(cameras_only, *name)};
  }
  std::vector<Camera> matching;
  for (const Camera& camera : cameras) {
    if (::fnmatch(name->c_str(), camera.name.c_str(), FNM_EXTMATCH) == 0) {
      matching.push_back(camera);
    }
  }
  if (matching.empty()) {
    throw InputError(cameras_only.file, "", fmt::format("no camera matches '{}'", *name));
  }
  return matching;
}

void add_settings(ContentHash& hash, std::vector<Setting> settings) {
  std::ranges::sort(settings, {}, &Setting::name);
  for (const Setting& setting : settings) {
    hash.add(setting.name);
    hash.add(setting.value ? '=' + *setting.value : "");
  }
}

/// Settings of the picture alone. What is not listed counts for pass one:
/// at worst it is solved once too often. States of a scene are known by what is there then.
bool is_of_pass_two(const Setting& setting) {
  constexpr std::array names{"mode",      "diffuse",     "camera",      "size",          "samples",
                             "max-error", "max-seconds", "exposure",    "layers",        "float",
                             "view",      "view-transform", "filter",      "pixel-error", "glossy-samples",
                             "at",        "variant",        "projection",  "depth",         "lamp"};
  return std::ranges::find(names, setting.name) != names.end();
}

std::string solution_key(const SceneFacts& facts, const JobMode& mode) {
  std::vector<Setting> settings = mode.settings;
  std::erase_if(settings, is_of_pass_two);
  ContentHash hash;
  hash.add(program_version());
  hash.add(facts.hash);
  hash.add(mode.environment);
  // One solution by lamp serves all states of lamps.
  const RunSettings& wanted = mode.request.settings;
  if (!wanted.lamp_factors.empty() || wanted.lamp_layers)
    hash.add("by lamp");
  add_settings(hash, std::move(settings));
  return hex_digits(hash.value());
}

std::string picture_key(const BatchPicture& picture, const JobMode& mode) {
  ContentHash hash;
  hash.add(program_version());
  hash.add(picture.facts->hash);
  hash.add(picture.scene.filename().string());
  add_camera(hash, picture.camera);
  hash.add(static_cast<std::uint64_t>(picture.size.width));
  hash.add(static_cast<std::uint64_t>(picture.size.height));
  hash.add(mode.environment);
  add_settings(hash, mode.settings);
  for (const fs::path& output : picture.outputs) {
    hash.add(output.string());
  }
  return hex_digits(hash.value());
}

/// What a job asks for in one scene, in one of its states.
struct JobScene {
  const BatchJob& job;
  const fs::path& scene;
  const SceneState& state;
  std::size_t frame; ///< of the job's times
  const KnownScene& known;
};

BatchPicture broken_picture(const BatchJob& job, const fs::path& scene, BatchProblem problem,
                            std::optional<std::size_t> frame = std::nullopt) {
  BatchPicture picture;
  picture.name = fmt::format("{} {}", job.place, scene.string()) +
                 (frame ? fmt::format(" frame {}", *frame) : "");
  picture.job = job.name;
  picture.scene = scene;
  picture.problem = std::move(problem);
  return picture;
}

BatchPicture picture_of(const JobScene& at, const JobMode& mode, const Camera& camera, int frame) {
  BatchPicture picture;
  picture.job = at.job.name;
  picture.mode = mode.name;
  picture.scene = at.scene;
  picture.facts = at.known.facts;
  picture.camera = projected(camera, mode.request.settings);
  picture.frame = frame;
  picture.size = choose_size(mode.request.size, picture.camera);
  picture.request = mode.request;
  picture.request.scene = at.scene;
  picture.request.settings.gltf.state = at.state;
  const NameParts parts{at.scene.stem().string(), camera.name, mode.name, at.job.name, frame};
  for (const std::string& name_template : at.job.outputs) {
    picture.outputs.push_back(output_name(name_template, parts));
  }
  picture.request.settings.display = display_of(picture.outputs, mode.request.picture);
  picture.name = picture.outputs.front().string();
  picture.key = picture_key(picture, mode);
  const RunSettings& settings = mode.request.settings;
  if (settings.mode != PictureMode::reference && !settings.lamp_factors.empty() &&
      settings.layers == WithLayers::yes)
    throw UsageError("layers", "what mirrors bring is not known of lamps: `light` does not go with "
                               "`lamp`");
  if (mode.request.settings.mode != PictureMode::reference) {
    picture.solution_key = solution_key(*at.known.facts, mode);
  }
  return picture;
}

void add_pictures(const JobScene& at, std::vector<BatchPicture>& pictures) {
  const auto frame_of_time = at.job.times.empty() ? std::nullopt : std::optional(at.frame);
  if (at.known.problem) {
    pictures.push_back(broken_picture(at.job, at.scene, *at.known.problem, frame_of_time));
    return;
  }
  Scene named;
  named.file = at.scene.string();
  named.cameras = at.known.facts->cameras;
  for (const CameraChoice& choice : at.job.cameras) {
    try {
      auto cameras = chosen_cameras(choice, named, at.known.facts->bounds,
                                    at.job.modes.front().request.settings);
      const bool path = std::holds_alternative<CameraPath>(choice);
      if (path && !at.job.times.empty()) {
        cameras = {cameras.at(at.frame)}; // side by side with the animations
      }
      for (std::size_t k = 0; k < cameras.size(); ++k) {
        const std::size_t frame = path && at.job.times.empty() ? k : at.frame;
        for (const JobMode& mode : at.job.modes) {
          pictures.push_back(picture_of(at, mode, cameras[k], static_cast<int>(frame)));
        }
      }
    } catch (const UserError& error) {
      const int code = static_cast<int>(ExitCode::bad_input);
      pictures.push_back(broken_picture(at.job, at.scene, {error.what(), code}, frame_of_time));
    }
  }
}

/// No file may belong to two pictures: which of them it showed in the end would be chance.
void check_distinct(const fs::path& file, const BatchJob& job,
                    std::span<const BatchPicture> pictures,
                    std::map<fs::path, std::string>& owners) {
  for (const BatchPicture& picture : pictures) {
    const std::string owner =
        fmt::format("{} (scene {}, camera {}, mode {}, frame {})", job.place,
                    picture.scene.string(), picture.camera.name, picture.mode, picture.frame);
    for (const fs::path& output : picture.outputs) {
      const auto [other, is_new] = owners.emplace(output, owner);
      if (!is_new) {
        throw InputError(
            file.string(), job.place,
            fmt::format("'{}' would be two pictures, {} and {}: name its outputs by more "
                        "of {{job}}, {{scene}}, {{camera}}, {{mode}}, {{frame}}",
                        output.string(), other->second, owner));
      }
    }
  }
}

} // namespace

SceneFacts facts_of(const Scene& scene) {
  return {content_hash(scene), scene.cameras, bounds_of(scene),
          sizes_of(scene, LampGrouping::node)};
}

std::vector<BatchPicture> plan_batch(const fs::path& file, const std::vector<BatchJob>& jobs,
                                     const GltfSettings& gltf) {
  const FoundFiles found = find_files(jobs);
  const KnownScenes scenes = read_scenes(found, jobs, gltf);
  std::map<fs::path, std::string> owners;
  std::vector<BatchPicture> pictures;
  for (const BatchJob& job : jobs) {
    const std::size_t first = pictures.size();
    const std::vector<SceneState> states = states_of(job);
    std::set<fs::path> seen;
    for (const fs::path& pattern : job.scenes) {
      const auto& files = found.at(pattern);
      if (files.empty()) {
        const int code = static_cast<int>(ExitCode::bad_input);
        pictures.push_back(
            broken_picture(job, pattern, {pattern.string() + ": no file matches", code}));
      }
      for (const fs::path& scene : files) {
        if (!seen.insert(scene).second) {
          continue;
        }
        for (std::size_t k = 0; k < states.size(); ++k) {
          add_pictures({job, scene, states[k], k, scenes.at({scene, states[k]})}, pictures);
        }
      }
    }
    for (BatchPicture& picture : std::span(pictures).subspan(first)) {
      const SceneState state = picture.request.settings.gltf.state;
      picture.request.settings.gltf = gltf;
      picture.request.settings.gltf.state = state;
    }
    check_distinct(file, job, std::span(pictures).subspan(first), owners);
  }
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    pictures[k].number = k;
  }
  return pictures;
}

std::vector<BatchPicture> pictures_of(std::vector<BatchPicture> pictures,
                                      const std::vector<NumberRange>& only) {
  for (const NumberRange& range : only) {
    if (range.last >= pictures.size()) {
      throw UsageError("--only", fmt::format("no picture {}: the batch has {}, from 0 on",
                                             range.last, pictures.size()));
    }
  }
  std::erase_if(pictures, [&](const BatchPicture& picture) {
    return !only.empty() && std::ranges::none_of(only, [&](const NumberRange& range) {
      return range.first <= picture.number && picture.number <= range.last;
    });
  });
  return pictures;
}

std::vector<BatchPicture> pictures_of(std::vector<BatchPicture> pictures, const Shard& shard) {
  const auto count = static_cast<std::size_t>(shard.count);
  const std::size_t number = static_cast<std::size_t>(shard.number);
  const auto begin =
      pictures.begin() + static_cast<std::ptrdiff_t>(pictures.size() * number / count);
  const auto end =
      pictures.begin() + static_cast<std::ptrdiff_t>(pictures.size() * (number + 1) / count);
  return {std::make_move_iterator(begin), std::make_move_iterator(end)};
}

} // namespace meninas
