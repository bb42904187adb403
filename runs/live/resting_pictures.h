// Pass two's pictures of what somebody looks at who stands still.
//
// A picture comes in two steps, a third as wide and high by few samples, and whole by those asked for, one picture at a
// time. A viewer who moves on before it is there ends it. The whole is that of `meninas render` with the command that
// command_of() gives, bit for bit.
#pragma once

#include "runs/preparation.h"
#include "runs/outputs.h"
#include "runs/view.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meninas {

/// The view of a viewer.
struct RestingView {
  std::string viewer;       ///< who
  std::uint64_t number = 0; ///< counts up with every move of theirs
  std::optional<std::string> camera; ///< of the file, as it is
  FreeCamera place;                  ///< otherwise
  PictureSize size;
  double exposure = 0.0; ///< stops, of a PNG
};

/// A solved room, and how its pictures are made.
struct SolvedRoom {
  LitScene lit;
  RadiositySolution solution;
  std::uint64_t scene_hash = 0; ///< of the scene as it was read
  std::filesystem::path scene;
  RunSettings settings;
  PictureSettings picture; ///< its exposure is the view's
};

enum class RestingStep { coarse, whole };

/// Thrown where there is no picture, with a sentence for whoever asked.
struct NoPictureNow {
  std::string why;
};
inline constexpr const char* not_solved_yet = "The room is not solved yet.";

class RestingPictures {
public:
  /// From now on; null: there is none.
  void show(std::shared_ptr<const SolvedRoom> room);
  std::shared_ptr<const SolvedRoom> room() const;

  /// Nothing where the viewer has moved on. Throws UserError, of a camera that the file has not, and NoPictureNow
  /// where there is no room or another by now, or where a picture of that viewer waits, or four of anybody.
  std::optional<std::vector<std::byte>> picture(const RestingView& view, RestingStep step, PictureFormat format);
  /// Pictures of lower numbers are not wanted any more.
  void moved(const std::string& viewer, std::uint64_t number);

private:
  struct Viewer {
    std::string name;
    std::shared_ptr<std::atomic<std::uint64_t>> number;
  };
  using Newest = std::shared_ptr<const std::atomic<std::uint64_t>>;
  Newest newest_of(const std::string& viewer, std::uint64_t number);
  /// True when it is this picture's turn, which done() ends; false where its viewer has moved on.
  bool wait_for_turn(const RestingView& view, const Newest& newest);
  void done();
  std::shared_ptr<const ViewPicture> rendered(const std::shared_ptr<const SolvedRoom>& room, const RestingView& seen,
                                              const RunSettings& settings, const Newest& newest);

  mutable std::mutex mutex_;
  std::condition_variable turns_;
  bool is_rendering_ = false;
  std::vector<std::pair<std::string, std::uint64_t>> waiting_; ///< viewers, with their numbers
  std::atomic<std::uint64_t> rooms_{0};                        ///< that were shown
  std::shared_ptr<const SolvedRoom> room_;
  std::deque<Viewer> viewers_; ///< the latest last
  struct Kept {
    std::string view; ///< what it is of
    std::shared_ptr<const SolvedRoom> room;
    std::shared_ptr<const ViewPicture> picture;
  } kept_; ///< the whole one made last: saving it makes it no second time
};

/// The view's camera, cut open where a section says so.
Camera camera_of(const SolvedRoom& room, const RestingView& view);

/// "meninas render room.gltf --camera main --size 640x480 ... -o view.exr -o view.png"
std::string command_of(const SolvedRoom& room, const RestingView& view, const std::string& name);

} // namespace meninas
