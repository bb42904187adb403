#include "runs/live/live_stages.h"

#include "radiosity/solvers/solve.h"
#include "runs/preparation.h"
#include "runs/report/run_progress.h"
#include "runs/run_stages.h"
#include "runs/steering/memory.h"
#include "runs/walk/walk_cameras.h"
#include "scenes/content_hash.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <mutex>

namespace meninas {

namespace {

/// Of an element of the coarse mesh, where it gathers: more rays than where it shoots, again and again; fewer where there
/// are many patches, so that rows take megabytes.
int rays_of_coarse_rows(std::size_t elements) {
  constexpr std::size_t all = 1 << 21, most = 256, least = 16;
  return static_cast<int>(std::bit_floor(std::clamp(all / std::max<std::size_t>(1, elements), least, most)));
}

/// Thrown where the other solver is asked for.
struct OtherSolver {};

/// Wall-clock time since it was made.
class SecondsSince {
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Progress of a stage for the board, at most some times a second, from any thread.
class StageProgress {
public:
  StageProgress(const LiveStage& stage, std::vector<RunStage> stages) : stage_(stage) {
    progress_.begin(std::move(stages), 0.0);
  }
  void report(std::string_view name, double fraction) {
    if (stage_.is_over())
      throw StageOver{};
    const std::scoped_lock lock(mutex_);
    const double now = since_.seconds();
    progress_.report(name, fraction, now);
    constexpr double between = 0.1;
    if (now < told_ + between)
      return;
    told_ = now;
    const RunState state = progress_.state(now);
    stage_.board.change_status([&](LiveStatus& status) {
      status.stage = state.stage;
      status.done = state.done;
      status.seconds_left = state.seconds_left;
    });
  }

private:
  const LiveStage& stage_;
  std::mutex mutex_;
  SecondsSince since_;
  double told_ = 0.0; // what was shown before is left long enough to be told
  RunProgress progress_;
};

/// Shows a room whose mesh stays the same while its light changes.
class ShownRoom {
public:
  ShownRoom(const LiveScene& shown, const LiveStage& stage) : shown_(shown), stage_(stage) {}

  void show(const IrradianceField& field, const Rgb& ambient, const StatusChange& change = {}) {
    if (room_) {
      stage_.board.show_light({irradiance_from(*field.scene, field, room_->origins), ambient}, change);
      return;
    }
    room_ = walk_room(field);
    const LiveLight light{irradiance_of(*room_), ambient};
    stage_.board.show_room(data_of(field, ambient), room_->middle, light,
                           {field.scene, room_->elements, two_pass_settings(shown_.settings).pass_one.form_factors}, change);
  }

private:
  std::string data_of(const IrradianceField& field, const Rgb& ambient) const {
    std::vector<std::string> left_out;
    std::string data = walk_page_data({.field = field,
                                       .room = *room_,
                                       .title = shown_.file.filename().string(),
                                       .cameras = walk_cameras(with_ambient(field, ambient), shown_.settings, shown_.exposure),
                                       .transform = shown_.transform,
                                       .luminous_efficacy = shown_.settings.gltf.state.luminous_efficacy,
                                       .packed = PackedSize::quick,
                                       .numbering = VertexNumbering::by_room},
                                      left_out);
    return data;
  }
  static IrradianceField with_ambient(const IrradianceField& field, const Rgb& ambient) {
    IrradianceField lit = field;
    for (auto* irradiances : {&lit.irradiance, &lit.indirect})
      for (glm::vec3& irradiance : *irradiances)
        irradiance += glm::vec3(ambient);
    return lit;
  }

  const LiveScene& shown_;
  const LiveStage& stage_;
  std::optional<WalkRoom> room_;
};

/// Each shot as a state; waits before the next where somebody wants that.
class ShownShots {
public:
  /// `gathers`: how these steps are made, where they may be made the other way.
  ShownShots(const LiveScene& shown, const LiveStage& stage, const SecondsSince& since,
             std::shared_ptr<const PreparedScene> prepared, std::optional<bool> gathers = std::nullopt)
      : gathers_(gathers), since_(since), shown_(shown), stage_(stage), prepared_(std::move(prepared)), light_(prepared_->light()), room_(shown, stage) {}

  /// The room before any light, if somebody wants to see that.
  void begin() {
    if (!stage_.steps.paused())
      return;
    const std::vector<glm::vec3> dark(light_->mesh.vertices.size(), glm::vec3(0.0F));
    // A room of its own: the exposure of the lit one is another. Whoever hears the stage can ask for this room at once.
    ShownRoom(shown_, stage_).show({{dark, {}, dark, {}}, light_}, Rgb(0.0), [](LiveStatus& status) { status.stage = "dark"; });
    wait();
  }
  void look(const PassOneSoFar& state, const char* steps) {
    if (stage_.is_over())
      throw StageOver{};
    room_.show({state.field, light_}, state.ambient, [&](LiveStatus& status) {
      status.stage = steps;
      status.shots = state.shots;
      status.unshot = state.unshot;
      status.elements = element_count(light_->mesh);
      status.seconds = since_.seconds();
    });
    wait();
  }

private:
  void wait() {
    if (stage_.steps.paused())
      stage_.steps.wait(stage_.is_over, gathers_);
  }

  std::optional<bool> gathers_;
  const SecondsSince& since_; ///< the scene was read
  const LiveScene& shown_;
  const LiveStage& stage_;
  std::shared_ptr<const PreparedScene> prepared_;
  std::shared_ptr<const LightScene> light_;
  ShownRoom room_;
};

/// Shots between states: telling one takes a time in proportion to the elements.
int shots_between(std::size_t elements) {
  constexpr std::size_t few = 2000;
  return static_cast<int>(1 + elements / few);
}

/// Of the coarse mesh each is a state, but where patches are many.
int coarse_shots_between(std::size_t elements) {
  constexpr std::size_t many = 1 << 14;
  return elements > many ? shots_between(elements) : 1;
}

/// By shots, or by sweeps; throws OtherSolver.
void solve_coarse(const LiveScene& shown, const LiveStage& stage, const SecondsSince& since,
                  const std::shared_ptr<const PreparedScene>& prepared, PassOneSettings settings) {
  const bool gathers = stage.steps.gathers();
  RunSettings coarse = coarse_settings(shown.settings);
  if (gathers) {
    settings.solver.method = coarse.solver = SolverMethod::jacobi;
    settings.form_factors.rays = rays_of_coarse_rows(element_count(prepared->mesh));
  }
  ShownShots shots(shown, stage, since, prepared, gathers);
  const auto check = [&] {
    if (stage.steps.gathers() != gathers)
      throw OtherSolver{};
  };
  stage.board.change_status([&](LiveStatus& status) {
    status.gathers = gathers;
    status.shots = 0;
    status.unshot.reset();
  });
  shots.begin();
  check();
  StageProgress progress(stage, pass_one_stages(coarse));
  const Progress told = [&](std::string_view name, double fraction) {
    check();
    progress.report(name, fraction);
  };
  const PassOneWatch watch{gathers ? 1 : coarse_shots_between(element_count(prepared->mesh)),
                           [&](const PassOneSoFar& state) {
                             shots.look(state, gathers ? "sweeps" : "shots");
                             check();
                           },
                           true};
  if (gathers)
    solve_pass_one(prepared->light(), rows_of(stage.kept.coarse, *prepared->light(), settings.form_factors, told), settings, told, watch);
  else
    shoot_pass_one(prepared->light(), settings, told, watch);
}

/// By rows that are there: one state, with all light.
void relight_coarse(const LiveScene& shown, const LiveStage& stage, const SecondsSince& since) {
  const auto& [prepared, settings, rows, whole] = stage.kept;
  const RadiositySolution solution = solve_pass_one(prepared->light(), rows.factors, settings);
  ShownRoom(shown, stage).show(solution.field, Rgb(0.0), [&](LiveStatus& status) {
    status.stage = "relit";
    status.is_relit = true;
    status.elements = element_count(prepared->mesh);
    status.seconds = since.seconds();
  });
}

void show_coarse(const Scene& scene, const LiveScene& shown, const LiveStage& stage, const SecondsSince& since) {
  PassOneSettings settings = two_pass_settings(coarse_settings(shown.settings)).pass_one;
  // A mean over an element that is as large as furniture has no sharp shadow anyway.
  settings.direct.points = 4;
  settings.direct.max_points = 16;
  settings.direct.images_in_element = 16;
  const std::shared_ptr<const PreparedScene> prepared = prepare_scene(scene, settings);
  stage.kept.coarse_scene = prepared;
  stage.kept.coarse_settings = settings;
  stage.kept.coarse_settings.solver.method = SolverMethod::jacobi;
  stage.kept.coarse_settings.form_factors.rays = rays_of_coarse_rows(element_count(prepared->mesh));
  if (!stage.steps.paused() && are_of(stage.kept.coarse, *prepared->light(), stage.kept.coarse_settings.form_factors))
    return relight_coarse(shown, stage, since);
  for (bool done = false; !done;) {
    try {
      solve_coarse(shown, stage, since, prepared, settings);
      done = true;
    } catch (const OtherSolver&) {
      // From the beginning, the other way.
    }
  }
}

/// As `solve` has it; rows of elements, where there are some, are kept.
RadiositySolution solve_whole(KeptOfScene& kept, const std::shared_ptr<const LightScene>& light, const PassOneSettings& settings,
                              const Progress& progress, const PassOneWatch& watch) {
  if (settings.cut == MeshCut::hierarchical || nothing_emits(*light) || shoots_rays(settings, element_count(light->mesh)))
    return solve_pass_one(light, settings, progress, watch);
  check_size(settings.solver.method, element_count(light->mesh));
  return solve_pass_one(light, rows_of(kept.whole, *light, settings.form_factors, progress), settings, progress, watch);
}

} // namespace

RunSettings coarse_settings(RunSettings settings) {
  constexpr int elements = 1000, rays = 32;
  constexpr double tolerance = 0.02;
  settings.quality = Quality::draft;
  settings.element_size.reset();
  settings.elements = elements;
  settings.mesh = MeshCut::uniform;
  settings.bends.reset();
  settings.form_factors = FormFactorMethod::rays;
  settings.rays = rays;
  settings.solver = SolverMethod::progressive;
  settings.tolerance = tolerance;
  settings.steps.reset();
  settings.link_error.reset();
  settings.interpolation = Interpolation::average;
  settings.lamps.reset();
  return settings;
}

void keep_rows(const LiveStage& stage) {
  constexpr std::size_t max_elements = 1 << 14; // of more, rows would take seconds and tell little
  const std::shared_ptr<const PreparedScene> prepared = stage.kept.coarse_scene;
  if (element_count(prepared->mesh) > max_elements)
    return;
  rows_of(stage.kept.coarse, *prepared->light(), stage.kept.coarse_settings.form_factors, [&](std::string_view, double) {
    if (stage.is_over())
      throw StageOver{};
  });
  stage.board.change_status([](LiveStatus& status) { status.keeps_rows = true; });
}

void show_solved(const SolvedRoom& room, const LiveScene& shown, const LiveStage& stage) {
  ShownRoom(shown, stage).show(room.solution.field, Rgb(0.0));
}

std::shared_ptr<const SolvedRoom> show_stages(Scene scene, const LiveScene& shown, const LiveStage& stage) {
  const SecondsSince since;
  stage.board.change_status([&](LiveStatus& status) {
    const std::string problem = std::move(status.problem);
    status = {};
    status.problem = problem;
    status.stage = "first pictures";
    status.paused = stage.steps.paused();
    status.gathers = stage.steps.gathers();
  });
  check_memory(scene, shown.settings, std::nullopt);
  show_coarse(scene, shown, stage, since);

  const PassOneSettings settings = two_pass_settings(shown.settings).pass_one;
  RunFigures figures;
  const std::uint64_t scene_hash = content_hash(scene);
  const std::shared_ptr<const PreparedScene> prepared = prepare_run(std::move(scene), settings, stage.events, figures);
  ShownShots shots(shown, stage, since, prepared);
  const char* const steps = settings.solver.method == SolverMethod::jacobi ? "sweeps" : "shots";
  StageProgress progress(stage, pass_one_stages(shown.settings));
  RadiositySolution solution = solve_whole(
      stage.kept, prepared->light(), settings,
      [&](std::string_view name, double fraction) {
        progress.report(name, fraction);
        stage.board.change_status([&](LiveStatus& status) { status.seconds = since.seconds(); });
      },
      {shots_between(element_count(prepared->mesh)), [&](const PassOneSoFar& state) { shots.look(state, steps); }, true});
  add_solution(figures, solution);
  warn_of_solution(*prepared, figures.solver, figures.closure, stage.events);
  ShownRoom(shown, stage).show(solution.field, Rgb(0.0));
  const LitScene lit{prepared, solution.field};
  auto room = std::make_shared<SolvedRoom>(SolvedRoom{.lit = lit,
                                                      .solution = std::move(solution),
                                                      .scene_hash = scene_hash,
                                                      .scene = shown.file,
                                                      .settings = shown.settings,
                                                      .picture = {}});
  room->picture.transform = shown.transform;
  if (stage.is_over())
    throw StageOver{};
  stage.solved(room);
  stage.board.change_status([&](LiveStatus& status) {
    status = {.stage = "solved",
              .done = 1.0,
              .seconds_left = 0.0,
              .seconds = since.seconds(),
              .shots = status.shots,
              .unshot = std::nullopt,
              .error = figures.solver.error_bound,
              .elements = figures.elements,
              .solved = true,
              .is_relit = status.is_relit,
              .problem = status.problem};
  });
  return room;
}

} // namespace meninas
