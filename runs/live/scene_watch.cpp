#include "runs/live/scene_watch.h"

#include "runs/preparation.h"
#include "scenes/errors.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <exception>
#include <fstream>
#include <new>

namespace meninas {

namespace fs = std::filesystem;

namespace {

/// RFC 3986, section 2.1.
std::string without_percents(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    unsigned code = 0;
    if (text[k] == '%' && k + 2 < text.size() && std::sscanf(text.c_str() + k + 1, "%2x", &code) == 1) {
      plain += static_cast<char>(code);
      k += 2;
    } else
      plain += text[k];
  }
  return plain;
}

std::vector<FileState> states_of(const std::vector<fs::path>& files) {
  std::vector<FileState> states;
  for (const fs::path& file : files) {
    std::error_code no_size, no_time;
    const std::uintmax_t size = fs::file_size(file, no_size);
    const fs::file_time_type time = fs::last_write_time(file, no_time);
    states.emplace_back(file, no_size ? 0 : size, no_time ? fs::file_time_type{} : time);
  }
  return states;
}

} // namespace

std::vector<fs::path> files_of_scene(const fs::path& scene, const RunSettings& settings) {
  std::vector<fs::path> files = files_beside_scene(settings);
  files.push_back(scene);
  std::error_code unknown;
  if (scene.extension() == ".glb" || !fs::is_regular_file(scene, unknown)) // all is in it, as a rule
    return files;
  std::ifstream in(scene, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  if (!root.is_object())
    return files;
  for (const char* list : {"buffers", "images"}) {
    const auto members = root.find(list);
    if (members == root.end() || !members->is_array())
      continue;
    for (const nlohmann::json& member : *members)
      if (const auto uri = member.is_object() ? member.find("uri") : member.end();
          uri != member.end() && uri->is_string() && !uri->get_ref<const std::string&>().starts_with("data:"))
        files.push_back(scene.parent_path() / without_percents(*uri));
  }
  return files;
}

SceneWatch::SceneWatch(fs::path scene, RunSettings settings, std::function<void(const std::string&)> told)
    : file_(std::move(scene)), settings_(std::move(settings)), told_(std::move(told)),
      files_(files_of_scene(file_, settings_)), known_(states_of(files_)), watching_([this] { watch(); }) {}

SceneWatch::~SceneWatch() {
  over_ = true;
  watching_.join();
}

void SceneWatch::watch() {
  constexpr std::chrono::milliseconds between(300);
  std::vector<FileState> last = known_;
  while (!over_) {
    std::this_thread::sleep_for(between);
    try {
      look(last);
    } catch (const std::bad_alloc&) {
      told_(file_.string() + ": not enough memory");
    } catch (const std::exception& error) {
      told_(error.what());
    }
  }
}

void SceneWatch::look(std::vector<FileState>& last) {
  const auto now = states_of(files_);
  const bool is_still = now == last;
  last = now;
  if (!is_still || now == known_)
    return;
  known_ = now;
  files_ = files_of_scene(file_, settings_);
  last = known_ = states_of(files_);
  Scene scene = load_relit_scene(file_, settings_);
  told_("");
  const std::scoped_lock lock(mutex_);
  newer_ = std::move(scene);
  has_changed_ = true;
  news_.notify_all();
}

Scene SceneWatch::next() {
  std::unique_lock lock(mutex_);
  news_.wait(lock, [this] { return newer_.has_value(); });
  Scene scene = std::move(*newer_);
  newer_.reset();
  has_changed_ = false;
  return scene;
}

} // namespace meninas
