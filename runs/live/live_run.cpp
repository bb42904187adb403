#include "runs/live/live_run.h"

#include "runs/live/live_answers.h"
#include "runs/live/live_stages.h"
#include "runs/live/scene_watch.h"
#include "runs/live/web_server.h"
#include "runs/preparation.h"
#include "runs/resources.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <chrono>
#include <new>

namespace meninas {

namespace {

std::string figures_of(const RadiositySolution& solution) {
  return fmt::format("solved: {} elements, error bound {:.2g}", element_count(solution.field.mesh()), solution.solver.error_bound);
}

/// The room that was solved last, and what was said of it.
struct LastSolved {
  std::shared_ptr<const SolvedRoom> room;
  LiveStatus status;
};

/// In place of one that cannot be solved; nothing changes before there is one.
void show_again(const LastSolved& last, const LiveScene& shown, const LiveStage& stage) {
  if (!last.room)
    return stage.board.change_status([](LiveStatus& status) { status.stage = "not solved"; });
  show_solved(*last.room, shown, stage);
  stage.solved(last.room);
  stage.board.change_status([&](LiveStatus& status) { status = last.status; });
}

/// Of errors that are no user's, with the file in front.
std::string line_of(const std::exception& error, const std::filesystem::path& file) {
  if (dynamic_cast<const UserError*>(&error) != nullptr)
    return error.what();
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return fmt::format("{}: {}", file.string(), is_memory ? "not enough memory" : error.what());
}

} // namespace

void live_run(const LiveRequest& request, const std::function<void(const std::string&)>& opened, const RunEvents& events) {
  const ThreadLimit limit(request.settings.threads);
  LiveBoard board;
  ShotSteps steps(request.paused);
  RestingPictures pictures;
  FactorRows factors;
  const auto tell_problem = [&](const std::string& problem) {
    board.change_status([&](LiveStatus& status) { status.problem = problem; });
    if (!problem.empty())
      warn(events, problem);
  };
  SceneWatch watch(request.scene, request.settings, tell_problem);
  Scene scene = load_relit_scene(request.scene, request.settings);
  const WebServer server(request.port, LiveAnswers{board, steps, pictures, factors},
                         [&](std::uint64_t& seen, std::chrono::milliseconds patience) { return board.next(seen, patience); });
  opened(server.address());

  const LiveScene shown{request.scene, request.settings, request.transform, request.exposure};
  KeptOfScene kept;
  const LiveStage stage{board, steps, [&] { return watch.has_changed(); },
                        [&](std::shared_ptr<const SolvedRoom> room) { pictures.show(std::move(room)); },
                        kept,
                        {events.warning, {}, {}, {}}};
  LastSolved last;
  for (bool first = true;; first = false) {
    try {
      last.room = show_stages(std::move(scene), shown, stage);
      last.status = board.status();
      note(events, figures_of(last.room->solution));
      keep_rows(stage);
    } catch (const StageOver&) {
      // Another scene waits.
    } catch (const std::exception& error) {
      if (first)
        throw;
      show_again(last, shown, stage);
      tell_problem(line_of(error, request.scene));
    }
    scene = watch.next();
    pictures.show(nullptr);
    note(events, fmt::format("{} has changed", request.scene.string()));
  }
}

} // namespace meninas
