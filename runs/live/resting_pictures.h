// Pass two's pictures of what somebody looks at who stands still.
//
// A picture comes in two steps, a third as wide and high by few samples, and whole by those asked for, one picture at a
// time. Who moves on before it is there ends it. The whole one is that of `meninas render` with the command that
// command_of() gives, bit for bit.
#pragma once

#include "runs/preparation.h"
#include "runs/outputs.h"
#include "runs/view.h"

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace meninas {

/// What somebody looks at.
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

class RestingPictures {
public:
  /// From now on; null: there is none.
  void show(std::shared_ptr<const SolvedRoom> room);
  std::shared_ptr<const SolvedRoom> room() const;

  /// Nothing where there is no room, or where the viewer has moved on. Throws UserError, of a camera that
  /// the file has not.
  std::optional<std::vector<std::byte>> picture(const RestingView& view, RestingStep step, PictureFormat format);
  /// Pictures of lower numbers are not wanted any more.
  void moved(const std::string& viewer, std::uint64_t number);

private:
  struct Viewer {
    std::string name;
    std::shared_ptr<std::atomic<std::uint64_t>> number;
  };
  std::shared_ptr<const std::atomic<std::uint64_t>> newest_of(const std::string& viewer, std::uint64_t number);

  mutable std::mutex mutex_;
  std::mutex rendering_;
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
