#include "runs/steering/steering.h"

#include "radiosity/scene/small_elements.h"
#include "raytrace/pixels/sample_choice.h"
#include "runs/report/percent.h"
#include "runs/run_stages.h"
#include "runs/steering/error_report.h"
#include "runs/preparation.h"
#include "runs/steering/setting_options.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace meninas {

namespace {

/// Thrown where work tells its progress, to end it.
struct OutOfTime {};

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The presets' link errors, between them and beyond: half of it for four times as many elements.
double link_error_of(double elements) {
  const PassOneQuality normal = pass_one_quality(Quality::normal);
  const double error = normal.link_error * std::sqrt(normal.target_elements / elements);
  return std::round(1e4 * error) * 1e-4;
}

/// The settings as they are with these knobs.
RunSettings with_knobs(RunSettings settings, const FreeKnobs& free, const Parameters& knobs) {
  settings.quality = Quality::draft;
  if (free.elements)
    settings.elements = static_cast<int>(knobs.elements);
  if (!settings.link_error && mesh_cut(settings) == MeshCut::hierarchical)
    settings.link_error = link_error_of(knobs.elements);
  if (free.rays)
    settings.rays = knobs.rays;
  if (free.samples)
    settings.samples = knobs.samples;
  settings.diffuse = knobs.term;
  return settings;
}

FreeKnobs free_knobs(const RunSettings& settings) {
  return {.elements = !settings.element_size && !settings.elements,
          .rays = !settings.rays && settings.form_factors == FormFactorMethod::rays,
          .samples = !settings.samples,
          .term = !settings.diffuse && settings.mode == PictureMode::hybrid &&
                  tells_light_apart(settings)};
}

Parameters first_knobs(const RunSettings& settings) {
  Parameters knobs;
  const QualityPreset draft = preset_of(Quality::draft);
  if (settings.element_size)
    knobs.elements = draft.target_elements;
  if (settings.elements)
    knobs.elements = *settings.elements;
  knobs.rays = settings.rays.value_or(settings.form_factors == FormFactorMethod::rays ? knobs.rays
                                                                                      : draft.rays);
  knobs.samples = settings.samples.value_or(knobs.samples);
  knobs.term = settings.diffuse.value_or(knobs.term);
  return knobs;
}

/// What is asked for, with adaptive samples where their number is free.
RunSettings settings_of(const SteeringRequest& request) {
  constexpr double pixel_share = 1.0, finest = 0.02, bends_that_show = 0.1;
  RunSettings settings = request.settings;
  if (!settings.samples && !settings.pixel_error && settings.mode == PictureMode::hybrid)
    settings.pixel_error = request.goal.error ? pixel_share * *request.goal.error : finest;
  // A few small elements at the feet of lit walls cost little, and save dividing all.
  const bool gathers =
      settings.interpolation.value_or(Interpolation::gather) == Interpolation::gather;
  if (!settings.bends && gathers && mesh_cut(settings) == MeshCut::uniform)
    settings.bends = bends_that_show;
  return settings;
}

/// One run under way, with what later ones can use of it.
struct Steering {
  const SteeringRequest& request;
  const RunEvents& events;
  RunSettings settings; ///< that knobs are turned of
  FreeKnobs free;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::optional<LitScene> lit = {};
  RunFigures figures = {}; ///< of `lit`
  std::optional<Parameters> lit_with = {};
  bool warned = false;

  double left() const {
    return request.goal.seconds ? *request.goal.seconds - request.reserve - request.spent - spent()
                                : no_limit;
  }
  double spent() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
};

struct SteeredRun {
  ViewPicture picture;
  RunFigures figures;
  MeasuredRun measured;
};

/// Warnings are said once; a later run ends when the time does.
RunEvents events_of(Steering& steering, bool may_end) {
  RunEvents events;
  if (!steering.warned)
    events.warning = steering.events.warning;
  events.progress = [&steering, may_end](std::string_view stage, double fraction) {
    if (may_end && steering.left() < 0.0)
      throw OutOfTime{};
    if (steering.events.progress)
      steering.events.progress(stage, fraction);
  };
  return events;
}

/// Pass one as these knobs want it, unless it is there.
void light_scene(Steering& steering, const Parameters& knobs, const TwoPassSettings& settings,
                 const RunEvents& events) {
  if (steering.lit_with && steering.lit_with->elements == knobs.elements &&
      steering.lit_with->rays == knobs.rays)
    return;
  steering.lit.reset();
  steering.lit_with.reset();
  RunFigures figures;
  Scene scene = steering.request.scene;
  auto prepared = prepare_run(std::move(scene), settings.pass_one, events, figures);
  RadiositySolution solution =
      solve_for_picture(*prepared, steering.request.camera, settings, events.progress);
  add_solution(figures, solution);
  warn_of_solution(*prepared, figures.solver, figures.closure, events);
  steering.lit = LitScene{std::move(prepared), std::move(solution.field)};
  steering.lit_with = knobs;
  steering.figures = figures;
}

double mean_count(const SampleCounts& samples, int everywhere) {
  if (samples.empty())
    return everywhere;
  return std::accumulate(samples.begin(), samples.end(), 0.0) / double(samples.size());
}

/// Of pixels that would take more samples than they could, than four times as many, and so on.
/// Errors fall with n^-0.6 between noise and edges.
std::array<double, 4> uncertain_shares(const Image& picture, const RenderSettings& render) {
  std::array<double, 4> shares{1.0, 1.0, 1.0, 1.0};
  constexpr double first = 4.0; // samples, of which uncertain_pixels() judges
  double samples = render.samples;
  for (double& share : shares) {
    if (render.pixel_error > 0.0) {
      const PixelMask uncertain =
          uncertain_pixels(picture, render.pixel_error * std::pow(samples / first, 0.6));
      share = double(std::ranges::count(uncertain, 1)) / double(uncertain.size());
    }
    samples *= 4.0;
  }
  return shares;
}

SteeredRun run_with(Steering& steering, const Parameters& knobs, bool may_end) {
  const SteeringRequest& request = steering.request;
  const RunSettings settings = with_knobs(steering.settings, free_knobs(steering.settings), knobs);
  TwoPassSettings two_pass = two_pass_settings(settings);
  two_pass.render.width = request.size.width;
  two_pass.render.height = request.size.height;
  begin_stages(steering.events, picture_stages(settings, WithPassOne::yes));
  const RunEvents events = events_of(steering, may_end);
  light_scene(steering, knobs, two_pass, events);
  steering.warned = true;

  const LitScene& lit = *steering.lit;
  SteeredRun run{{}, steering.figures, {}};
  run.picture = render_view(lit, request.camera, request.size, settings, events, run.figures);
  Stopwatch watch;
  PictureErrorSettings how = error_settings(two_pass, sampled_elements(*lit.field.scene));
  constexpr int more = 2; // what is decided by it deserves more pixels than what is only said
  how.gathered_pixels *= more;
  how.pixels = std::min(how.pixels * more, request.size.width * request.size.height);
  const PictureError error =
      estimate_error(lit.field, request.camera, two_pass, run.figures.solver,
                     {run.picture.image, run.picture.samples, run.picture.finer.get()}, how);
  run.picture.finer.reset();
  run.figures.error_estimate = error;
  run.figures.seconds.estimate = watch.lap();
  const RunSeconds& seconds = run.figures.seconds;
  run.measured = {knobs,
                  error,
                  seconds.plan + seconds.mesh + seconds.form_factors + seconds.solve +
                      seconds.interpolate,
                  seconds.render,
                  seconds.estimate,
                  double(request.size.width) * request.size.height,
                  double(run.figures.solved_elements),
                  mean_count(run.picture.samples, knobs.samples),
                  uncertain_shares(run.picture.image, two_pass.render)};
  return run;
}

std::string describe_step(const SteeredStep& step, std::size_t number) {
  return fmt::format(
      "step {}: {} elements, {} rays, {} samples, {}; {:.2f} s, about {} off", number,
      step.elements, step.rays, step.samples, name_of(step.term), step.seconds,
      readable_percent(step.error));
}

void add_seconds(RunSeconds& sum, const RunSeconds& more, bool pass_one) {
  if (pass_one) {
    sum.plan += more.plan;
    sum.mesh += more.mesh;
    sum.form_factors += more.form_factors;
    sum.solve += more.solve;
    sum.interpolate += more.interpolate;
  }
  sum.render += more.render;
  sum.estimate += more.estimate;
}

/// What the choice has come to, in words.
void say_end(const SteeredChoice& choice, const RunEvents& events) {
  const SteeredStep& kept = choice.steps[choice.kept];
  std::string options;
  for (const std::string& option : choice.options)
    options += ' ' + option;
  if (choice.wanted_error && !choice.reached)
    warn(events, fmt::format("an error of {} was not reached: it is about {}",
                             readable_percent(*choice.wanted_error), readable_percent(kept.error)));
  note(events, fmt::format("kept step {}; the same picture again:{}", choice.kept + 1, options));
}

/// What did not do once will not do by being made again.
bool was_made(const SteeredChoice& choice, const Parameters& knobs) {
  return std::ranges::any_of(choice.steps, [&](const SteeredStep& step) {
    return Parameters{step.wanted_elements, step.rays, step.samples, step.term} == knobs;
  });
}

/// Parameters whose turning did not help: the estimate does not know what is wrong.
void leave_alone(FreeKnobs& free, const Parameters& before, const Parameters& turned) {
  free.elements = free.elements && turned.elements == before.elements;
  free.rays = free.rays && turned.rays == before.rays;
  free.samples = free.samples && turned.samples == before.samples;
  free.term = free.term && (turned.term == before.term || turned.term != DiffuseTerm::gather);
}

bool gathers(const MeasuredRun& run) { return run.knobs.term == DiffuseTerm::gather; }

/// How the mesh's error falls, if two meshes have been seen by the same light.
double mesh_exponent(const MeasuredRun& before, const MeasuredRun& now) {
  if (before.knobs.elements == now.knobs.elements || gathers(before) != gathers(now))
    return before.mesh_exponent;
  return before.knobs.elements < now.knobs.elements ? measured_mesh_exponent(before, now)
                                                    : measured_mesh_exponent(now, before);
}

/// Of several pictures the best, and what they have taught.
struct Search {
  Steering& steering;
  const RunEvents& events;
  SteeredChoice choice = {};
  std::optional<SteeredRun> best = {};
  RunSeconds seconds = {}; ///< of all

  double error() const { return best->measured.error.total; }

  /// Makes a picture; false when the time is over before it is ready.
  bool step(const NextRun& next) {
    constexpr double worthwhile = 0.9; // of the best error so far
    Stopwatch watch;
    const auto was = steering.lit_with;
    std::optional<SteeredRun> run;
    try {
      run = run_with(steering, next.knobs, best.has_value());
    } catch (const OutOfTime&) {
      note(events, "the time is over before the next picture is ready");
      return false;
    }
    add_seconds(seconds, run->figures.seconds, !was || was != steering.lit_with);
    const double error = run->measured.error.total;
    choice.steps.push_back({next.knobs.elements, run->figures.elements, next.knobs.rays,
                            next.knobs.samples, next.knobs.term, watch.lap(), error,
                            next.forecast.error, next.why});
    note(events, describe_step(choice.steps.back(), choice.steps.size()));
    double exponent = best ? mesh_exponent(best->measured, run->measured) : 1.0;
    if (best && error >= worthwhile * this->error())
      leave_alone(steering.free, best->measured.knobs, next.knobs);
    if (!best || error < this->error()) {
      if (best && gathers(run->measured) && !gathers(best->measured)) {
        // What elements reflect may well be known better by finer ones,
        // whatever they did to what is between vertices.
        steering.free.elements = free_knobs(steering.settings).elements;
        exponent = MeasuredRun{}.mesh_exponent;
      }
      best = std::move(run);
      choice.kept = choice.steps.size() - 1;
    }
    best->measured.mesh_exponent = exponent;
    return true;
  }
};

} // namespace

ViewPicture steer(const SteeringRequest& request, const RunEvents& events, RunFigures& figures) {
  constexpr int max_steps = 8;
  constexpr double error_margin = 0.7,
                   time_margin = 0.7;  // of a goal, that a forecast is held against
  constexpr double max_growth = 20.0; // of the time so far: the next run takes no longer
  constexpr double at_once =
      0.125; // of the error: parts so much smaller are not known well enough to be met yet
  const RunSettings settings = settings_of(request);
  Steering steering{request, events, settings, free_knobs(settings)};
  const double wanted = request.goal.error.value_or(0.0);

  Search search{steering, events};
  SteeredChoice& choice = search.choice;
  choice.wanted_error = request.goal.error;
  choice.wanted_seconds = request.goal.seconds;
  NextRun next{first_knobs(settings), {}, "a quick look"};
  for (int k = 0; k < max_steps && search.step(next); ++k) {
    choice.reached = !request.goal.error || search.error() <= wanted;
    if (request.goal.error && choice.reached)
      break;
    const MeasuredRun& measured = search.best->measured;
    next =
        next_run(measured, steering.free, std::max(error_margin * wanted, at_once * search.error()),
                 std::min(time_margin * steering.left(), max_growth * steering.spent()));
    if (next.knobs == measured.knobs || was_made(choice, next.knobs))
      break;
    note(events, fmt::format("next, because of {}", next.why));
  }
  SteeredRun& best = *search.best;
  choice.options = options_of(with_knobs(settings, free_knobs(settings), best.measured.knobs));
  say_end(choice, events);
  const int threads = figures.threads;
  search.seconds.load = figures.seconds.load;
  figures = best.figures;
  if (best.measured.error.mean_radiance > 0.0)
    figures.closing = describe_error(best.measured.error);
  figures.seconds = search.seconds;
  figures.threads = threads;
  figures.choice = std::move(choice);
  return std::move(best.picture);
}

} // namespace meninas
