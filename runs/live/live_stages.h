// The states of a scene that are shown from the first second on, one after another:
//
//   coarse   a uniform mesh of few elements, solved by shots (radiosity/solvers/progressive.h), H = D + G + what has been
//            shot, with the ambient term beside it; every shot is a state, of many patches every so many. Or by gathering, where somebody asks for it:
//            every sweep of Jacobi's method is a state, H = D + G + T X_k. Or at once, by rows that are kept (kept_rows.h)
//   solution pass one as `solve` has it with the same settings, to the bit, and its field. Where that shoots as well, its shots
//            are states, too
//
// The coarse mesh has a thousand elements or so, at least one to a patch: that is what the first picture takes.
#pragma once

#include "runs/live/kept_rows.h"
#include "runs/live/live_board.h"
#include "runs/live/resting_pictures.h"
#include "runs/live/shot_steps.h"
#include "runs/run_events.h"

#include <filesystem>
#include <functional>

namespace meninas {

/// Whom the states go to, and who may end them.
struct LiveStage {
  LiveBoard& board;
  ShotSteps& steps;
  std::function<bool()> is_over; ///< asked all the time: another scene waits
  std::function<void(std::shared_ptr<const SolvedRoom>)> solved; ///< gets the solution before anybody is told of it
  KeptOfScene& kept;
  RunEvents events;
};

/// The shown scene, and its settings.
struct LiveScene {
  std::filesystem::path file;
  RunSettings settings;
  ViewTransform transform = ViewTransform::neutral;
  std::optional<double> exposure; ///< stops; chosen for each camera otherwise
};

/// Thrown where work tells its progress, once the stage is over.
struct StageOver {};

/// The settings of the first pictures, after those that are asked for.
RunSettings coarse_settings(RunSettings settings);

/// While nothing else is to do: what the next state of the file is relit by, if only its light is another.
void keep_rows(const LiveStage& stage);

/// The solution's light alone.
void show_solved(const SolvedRoom& room, const LiveScene& shown, const LiveStage& stage);

/// Shows both stages and returns the solution. Throws StageOver, and UserError as `solve` and `walk` do.
std::shared_ptr<const SolvedRoom> show_stages(Scene scene, const LiveScene& shown, const LiveStage& stage);

} // namespace meninas
