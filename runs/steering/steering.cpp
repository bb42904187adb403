#include "runs/steering/steering.h"

#include "runs/report/percent.h"
#include "runs/steering/error_report.h"
#include "runs/steering/setting_options.h"
#include "runs/steering/steered_picture.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace {

std::string describe_step(const SteeredStep& step, std::size_t number) {
  return fmt::format(
      "step {}: {} elements, {} rays, {} samples, {}; {:.2f} s, {} off", number,
      step.elements, step.rays, step.samples, name_of(step.term), step.seconds,
      about_percent(step.error));
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
    warn(events, fmt::format("an error of {} was not reached: it is {}",
                             readable_percent(*choice.wanted_error), about_percent(kept.error)));
  note(events, fmt::format("kept step {}; the same picture again:{}", choice.kept + 1, options));
}

/// What did not do once will not do by being made again.
bool was_made(const SteeredChoice& choice, const Parameters& parameters) {
  return std::ranges::any_of(choice.steps, [&](const SteeredStep& step) {
    return Parameters{step.wanted_elements, step.rays, step.samples, step.term} == parameters;
  });
}

bool gathers(const MeasuredRun& run) { return run.parameters.term == DiffuseTerm::gather; }

/// How the mesh's error falls, if two meshes have been seen by the same light.
double mesh_exponent(const MeasuredRun& before, const MeasuredRun& now) {
  if (before.parameters.elements == now.parameters.elements || gathers(before) != gathers(now))
    return before.mesh_exponent;
  return before.parameters.elements < now.parameters.elements ? measured_mesh_exponent(before, now)
                                                    : measured_mesh_exponent(now, before);
}

/// Of several pictures the best, and what they have taught.
struct Search {
  Steering& steering;
  const RunEvents& events;
  SteeredChoice choice = {};
  std::optional<SteeredRun> best = {};
  MeasuredRun last = {}; ///< may be no better
  RunSeconds seconds = {}; ///< of all
  double rays = 0.0;       ///< likewise, where these are what is counted

  double error() const { return best->measured.error.total; }

  /// Makes a picture; false when the time is over before it is ready.
  bool step(const NextRun& next) {
    constexpr double worthwhile = 0.9; // of the best error so far
    Stopwatch watch;
    const auto was = steering.lit_with;
    std::optional<SteeredRun> run;
    steering.estimate_seconds = steering.counts_rays() ? 0.0 : next.forecast.estimate;
    try {
      run = run_with(steering, next.parameters, best.has_value());
    } catch (const OutOfTime&) {
      note(events, "the time is over before the next picture is ready");
      return false;
    }
    const bool solved = !was || was != steering.lit_with;
    add_seconds(seconds, run->figures.seconds, solved);
    const MeasuredRun& costs = run->measured;
    rays += (solved ? costs.pass_one_cost : 0.0) + costs.pass_two_cost + costs.estimate_cost;
    const double error = run->measured.error.total;
    last = costs;
    choice.steps.push_back({next.parameters.elements, run->figures.elements, next.parameters.rays,
                            next.parameters.samples, next.parameters.term, watch.lap(), error,
                            next.forecast.error, next.why});
    note(events, describe_step(choice.steps.back(), choice.steps.size()));
    double exponent = best ? mesh_exponent(best->measured, run->measured) : 1.0;
    if (best && error >= worthwhile * this->error())
      steering.free = worth_changing(steering.free, best->measured, run->measured);
    if (!best || error < this->error()) {
      if (best && gathers(run->measured) && !gathers(best->measured)) {
        // What elements reflect may well be known better by finer ones,
        // whatever they did to what is between vertices.
        steering.free.elements = free_parameters(steering.settings).elements;
        exponent = MeasuredRun{}.mesh_exponent;
      }
      best = std::move(run);
      choice.kept = choice.steps.size() - 1;
    }
    best->measured.mesh_exponent = exponent;
    last.mesh_exponent = exponent;
    return true;
  }
};

} // namespace

ViewPicture steer(const SteeringRequest& request, const RunEvents& events, RunFigures& figures) {
  constexpr int max_steps = 8;
  constexpr double error_margin = 0.7,
                   time_margin = 0.7;  // of a goal, that a forecast is held against
  constexpr double near = 1.5, near_margin = 0.9; // forecasts of little are more certain
  constexpr double max_growth = 20.0; // of the cost so far: the next run takes no more
  constexpr double at_once =
      0.125; // of the error: parts so much smaller are not known well enough to be met yet
  const RunSettings settings = settings_of(request);
  Steering steering{request, events, settings, free_parameters(settings)};
  const double wanted = request.goal.error.value_or(0.0);

  Search search{steering, events};
  SteeredChoice& choice = search.choice;
  choice.wanted_error = request.goal.error;
  choice.wanted_seconds = request.goal.seconds;
  NextRun next{first_parameters(settings), {}, "a quick look"};
  for (int k = 0; k < max_steps && search.step(next); ++k) {
    choice.reached = !request.goal.error || search.error() <= wanted;
    if (request.goal.error && choice.reached)
      break;
    const double margin = search.error() < near * wanted ? near_margin : error_margin;
    const auto next_after = [&](const MeasuredRun& run) {
      return next_run(run, steering.free, std::max(margin * wanted, at_once * search.error()),
                      steering.counts_rays()
                          ? max_growth * search.rays
                          : std::min(time_margin * steering.left(), max_growth * steering.spent()));
    };
    next = next_after(search.best->measured);
    // The best may ask for what was made after it and seemed no better: that one knows more of its own error.
    if (was_made(choice, next.parameters))
      next = next_after(search.last);
    if (was_made(choice, next.parameters))
      break;
    note(events, fmt::format("next, because of {}", next.why));
  }
  SteeredRun& best = *search.best;
  choice.options = options_of(with_parameters(settings, free_parameters(settings), best.measured.parameters));
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
