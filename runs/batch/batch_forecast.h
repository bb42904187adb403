// The time left of a batch, judged by the seconds of its tasks so far.
//
// Pictures of a kind (mode, diffuse term, quality) are expected to take equally long for a camera
// ray, solves equally long each. Tasks side by side share the threads, so these are seconds
// of tasks, of which as many are expected to pass in a second of the clock as have so far.
#pragma once

#include "runs/batch/batch_plan.h"

#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace meninas {

/// The tasks that are running; seconds since their begin.
struct TasksUnderWay {
  struct Picture {
    std::size_t picture = 0;
    double seconds = 0.0;
    double share = 0.0; ///< of its rays that is traced
  };
  std::vector<Picture> pictures;
  std::vector<double> solves;     ///< seconds of each
  std::size_t waiting_solves = 0; ///< not begun
};

class BatchForecast {
public:
  /// No picture waits.
  explicit BatchForecast(std::span<const BatchPicture> pictures);

  void waits(std::size_t picture);
  /// It has been begun, or is over.
  void waits_no_more(std::size_t picture);
  void made(std::size_t picture, double seconds);
  void solved(double seconds);

  /// By the clock, `elapsed` seconds after the batch began.
  /// Nothing as long as no picture, or no solve but some are to come, has been seen.
  std::optional<double> seconds_left(const TasksUnderWay& now, double elapsed) const;
  /// Camera rays of a picture, as far as its settings say.
  double camera_rays(std::size_t picture) const { return rays_[picture]; }

private:
  using Kind = std::tuple<PictureMode, DiffuseTerm, Quality>;
  struct Pace {
    double rays = 0.0, seconds = 0.0; ///< of what has been seen
    double waiting = 0.0;             ///< rays
  };

  std::map<Kind, Pace> kinds_;
  std::vector<Kind> kind_of_;
  std::vector<double> rays_;
  std::vector<bool> waits_;
  double solve_seconds_ = 0.0;
  std::size_t solves_ = 0;
};

} // namespace meninas
