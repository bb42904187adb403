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

namespace meninas {

namespace {

std::string figures_of(const RadiositySolution& solution) {
  return fmt::format("solved: {} elements, error bound {:.2g}", element_count(solution.field.mesh()), solution.solver.error_bound);
}

} // namespace

void live_run(const LiveRequest& request, const std::function<void(const std::string&)>& opened, const RunEvents& events) {
  const ThreadLimit limit(request.settings.threads);
  LiveBoard board;
  ShotSteps steps(request.paused);
  RestingPictures pictures;
  const auto tell_problem = [&](const std::string& problem) {
    board.change_status([&](LiveStatus& status) { status.problem = problem; });
    if (!problem.empty())
      warn(events, problem);
  };
  SceneWatch watch(request.scene, request.settings, tell_problem);
  Scene scene = load_relit_scene(request.scene, request.settings);
  const WebServer server(request.port, LiveAnswers{board, steps, pictures},
                         [&](std::uint64_t& seen, std::chrono::milliseconds patience) { return board.next(seen, patience); });
  opened(server.address());

  const LiveScene shown{request.scene, request.settings, request.transform, request.exposure};
  const LiveStage stage{board, steps, [&] { return watch.has_changed(); }, {events.warning, {}, {}, {}}};
  for (bool first = true;; first = false) {
    try {
      const auto room = show_stages(std::move(scene), shown, stage);
      pictures.show(room);
      note(events, figures_of(room->solution));
    } catch (const StageOver&) {
      // Another scene waits.
    } catch (const UserError& error) {
      if (first)
        throw;
      tell_problem(error.what());
    }
    scene = watch.next();
    note(events, fmt::format("{} has changed", request.scene.string()));
  }
}

} // namespace meninas
