// A scene's files, read again whenever they have changed on disk.
//
// A scene's files are the file itself, its buffers and images, and the files that the settings name besides. They are
// checked three times a second, by size and time of change, and read when they have been still for as long, because
// writing a file takes time. If a file cannot be read, that is told, and the scene read before stays.
#pragma once

#include "runs/run_settings.h"
#include "scenes/scene.h"

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace meninas {

/// The state of a file: its size, and its time of change.
using FileState = std::tuple<std::filesystem::path, std::uintmax_t, std::filesystem::file_time_type>;

class SceneWatch {
public:
  /// `told` gets the one line of an error, or "" where the file can be read again; by a thread of the watch.
  SceneWatch(std::filesystem::path scene, RunSettings settings, std::function<void(const std::string&)> told);
  ~SceneWatch();
  SceneWatch(const SceneWatch&) = delete;
  SceneWatch& operator=(const SceneWatch&) = delete;

  /// Whether there is a newer one than was taken.
  bool has_changed() const { return has_changed_; }
  /// The newer scene, waited for.
  Scene next();

private:
  void watch();
  /// Reads the scene where its files are still and others than those known. `last`: as they were a moment ago.
  void look(std::vector<FileState>& last);

  std::filesystem::path file_;
  RunSettings settings_;
  std::function<void(const std::string&)> told_;
  std::vector<std::filesystem::path> files_; ///< of the watch alone, as are their states
  std::vector<FileState> known_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::optional<Scene> newer_;
  std::atomic<bool> has_changed_{false}, over_{false};
  std::thread watching_;
};

/// The file, and those beside it that it is made of, as far as they are named by it.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene, const RunSettings& settings);

} // namespace meninas
