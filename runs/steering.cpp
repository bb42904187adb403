#include "runs/steering.h"

#include "radiosity/world_tail.h"
#include "runs/error_report.h"
#include "runs/preparation.h"
#include "runs/setting_options.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace meninas {

namespace {

/// Thrown where work tells its progress, to end it.
struct OutOfTime {};

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Three digits are enough for an edge of an element, and read well.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2.0);
  return std::stod(fmt::format("{:.10g}", std::round(x / unit) * unit));
}

/// The settings as they are with these knobs.
RunSettings with_knobs(RunSettings settings, const FreeKnobs& free, const Knobs& knobs,
                       double area) {
  settings.quality = Quality::draft;
  if (free.elements)
    settings.element_size = rounded(std::sqrt(area / knobs.elements));
  if (free.rays)
    settings.rays = knobs.rays;
  if (free.samples)
    settings.samples = knobs.samples;
  settings.diffuse = knobs.term;
  return settings;
}

FreeKnobs free_knobs(const RunSettings& settings) {
  return {.elements = !settings.element_size && settings.adaptive == WithAdaptivity::no,
          .rays = !settings.rays && settings.form_factors == FormFactorMethod::rays,
          .samples = !settings.samples,
          .term = settings.diffuse == DiffuseTerm::interpolated &&
                  settings.mode == PictureMode::hybrid};
}

Knobs first_knobs(const RunSettings& settings) {
  Knobs knobs;
  const QualityPreset draft = preset_of(Quality::draft);
  if (settings.element_size || settings.adaptive == WithAdaptivity::yes)
    knobs.elements = draft.target_elements;
  knobs.rays = settings.rays.value_or(settings.form_factors == FormFactorMethod::rays ? knobs.rays
                                                                                      : draft.rays);
  knobs.samples = settings.samples.value_or(knobs.samples);
  knobs.term = settings.diffuse;
  return knobs;
}

/// One run under way, with what later ones can use of it.
struct Steering {
  const SteeringRequest& request;
  const RunEvents& events;
  FreeKnobs free;
  double area;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::optional<LitScene> lit = {};
  RunFigures figures = {}; ///< of `lit`
  std::optional<Knobs> lit_with = {};
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
void light_scene(Steering& steering, const Knobs& knobs, const TwoPassSettings& settings,
                 const RunEvents& events) {
  if (steering.lit_with && steering.lit_with->elements == knobs.elements &&
      steering.lit_with->rays == knobs.rays)
    return;
  steering.lit.reset();
  steering.lit_with.reset();
  RunFigures figures;
  Scene scene = steering.request.scene;
  steering.lit = solve_lit_scene(std::move(scene), settings.pass_one, {}, events, figures);
  steering.lit_with = knobs;
  steering.figures = figures;
}

SteeredRun run_with(Steering& steering, const Knobs& knobs, bool may_end) {
  const SteeringRequest& request = steering.request;
  const RunSettings settings = with_knobs(request.settings, steering.free, knobs, steering.area);
  TwoPassSettings two_pass = two_pass_settings(settings);
  two_pass.render.width = request.size.width;
  two_pass.render.height = request.size.height;
  const RunEvents events = events_of(steering, may_end);
  light_scene(steering, knobs, two_pass, events);
  steering.warned = true;

  const LitScene& lit = *steering.lit;
  SteeredRun run{{}, steering.figures, {}};
  run.picture = render_view(lit, request.camera, request.size, settings, events, run.figures);
  Stopwatch watch;
  PictureErrorSettings how = error_settings(two_pass, element_count(lit.light().mesh));
  constexpr int more = 2; // what is decided by it deserves more pixels than what is only said
  how.gathered_pixels *= more;
  how.pixels = std::min(how.pixels * more, request.size.width * request.size.height);
  const PictureError error = estimate_error(lit.light(), lit.field, request.camera, two_pass,
                                            run.figures.solver, run.picture.image, how);
  run.figures.error_estimate = error;
  run.figures.seconds.estimate = watch.lap();
  const RunSeconds& seconds = run.figures.seconds;
  run.measured = {knobs,
                  error,
                  seconds.plan + seconds.mesh + seconds.form_factors + seconds.solve +
                      seconds.interpolate,
                  seconds.render,
                  seconds.estimate,
                  double(request.size.width) * request.size.height};
  return run;
}

std::string describe_step(const SteeredStep& step, std::size_t number) {
  return fmt::format(
      "step {}: {} elements, {} rays, {} samples, {}; {:.2f} s, error about {:.2g} %", number,
      step.elements, step.rays, step.samples, name_of(step.term), step.seconds, 100.0 * step.error);
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
    warn(events, fmt::format("an error of {:.2g} % was not reached: it is about {:.2g} %",
                             100.0 * *choice.wanted_error, 100.0 * kept.error));
  note(events, fmt::format("kept step {}; the same picture again:{}", choice.kept + 1, options));
}

} // namespace

ViewPicture steer(const SteeringRequest& request, const RunEvents& events, RunFigures& figures) {
  constexpr int most_steps = 8;
  constexpr double error_margin = 0.85,
                   time_margin = 0.7;  // of a goal, that a forecast is held against
  constexpr double worthwhile = 0.9;   // of the best error so far
  constexpr double most_growth = 20.0; // of the time so far: the next run takes no longer
  constexpr double at_once =
      0.125; // of the error: parts so much smaller are not known well enough to be met yet
  const double area = receiving_area(request.scene, find_surfaces(request.scene));
  Steering steering{request, events, free_knobs(request.settings), area};
  const double wanted = request.goal.error.value_or(0.0);

  SteeredChoice choice;
  choice.wanted_error = request.goal.error;
  choice.wanted_seconds = request.goal.seconds;
  std::optional<SteeredRun> best;
  RunSeconds all;
  NextRun next{first_knobs(request.settings), {}, "a quick look"};
  for (int k = 0; k < most_steps; ++k) {
    Stopwatch watch;
    const bool solved = steering.lit_with.has_value();
    const auto was = steering.lit_with;
    std::optional<SteeredRun> run;
    try {
      run = run_with(steering, next.knobs, best.has_value());
    } catch (const OutOfTime&) {
      note(events, "the time is over before the next picture is ready");
      break;
    }
    const bool again = !solved || was != steering.lit_with;
    add_seconds(all, run->figures.seconds, again);
    const double error = run->measured.error.total;
    choice.steps.push_back({next.knobs.elements, run->figures.elements, next.knobs.rays,
                            next.knobs.samples, next.knobs.term, watch.lap(), error,
                            next.forecast.error, next.why});
    note(events, describe_step(choice.steps.back(), choice.steps.size()));
    const MeasuredRun measured = run->measured;
    const bool helped = !best || error < worthwhile * best->measured.error.total;
    if (!best || error < best->measured.error.total) {
      best = std::move(run);
      choice.kept = choice.steps.size() - 1;
    }
    choice.reached = !request.goal.error || best->measured.error.total <= wanted;
    if (request.goal.error && choice.reached)
      break;
    // What did not help once is not worth more of it: the estimate does not know what is wrong.
    if (!helped)
      break;
    next = next_run(measured, steering.free, std::max(error_margin * wanted, at_once * error),
                    std::min(time_margin * steering.left(), most_growth * steering.spent()));
    if (next.knobs == measured.knobs)
      break;
    note(events, fmt::format("next, because of {}", next.why));
  }
  choice.options =
      options_of(with_knobs(request.settings, steering.free, best->measured.knobs, area));
  say_end(choice, events);
  all.load = figures.seconds.load;
  const int threads = figures.threads;
  figures = best->figures;
  figures.seconds = all;
  figures.threads = threads;
  figures.choice = std::move(choice);
  return std::move(best->picture);
}

} // namespace meninas
