#include "runs/steering/steered_picture.h"

#include "radiosity/scene/small_elements.h"
#include "raytrace/pixels/sample_choice.h"
#include "runs/preparation.h"
#include "runs/run_stages.h"
#include "scenes/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meninas {

RunSettings with_parameters(RunSettings settings, const FreeParameters& free, const Parameters& parameters) {
  if (free.elements)
    settings.elements = static_cast<int>(parameters.elements);
  if (!settings.link_error && mesh_cut(settings) == MeshCut::hierarchical)
    settings.link_error = link_error_for(parameters.rays);
  if (free.rays)
    settings.rays = parameters.rays;
  if (free.samples)
    settings.samples = parameters.samples;
  settings.diffuse = parameters.term;
  return settings;
}

FreeParameters free_parameters(const RunSettings& settings) {
  return {.elements = !settings.element_size && !settings.elements,
          .rays = !settings.rays && settings.form_factors == FormFactorMethod::rays,
          .samples = !settings.samples,
          .term = !settings.diffuse && settings.mode == PictureMode::hybrid &&
                  tells_light_apart(settings)};
}

Parameters first_parameters(const RunSettings& settings) {
  Parameters parameters;
  const QualityPreset draft = preset_of(Quality::draft);
  if (settings.element_size)
    parameters.elements = draft.target_elements;
  if (settings.elements)
    parameters.elements = *settings.elements;
  parameters.rays = settings.rays.value_or(settings.form_factors == FormFactorMethod::rays ? parameters.rays
                                                                                      : draft.rays);
  parameters.samples = settings.samples.value_or(parameters.samples);
  parameters.term = settings.diffuse.value_or(parameters.term);
  return parameters;
}

RunSettings settings_of(const SteeringRequest& request) {
  constexpr double pixel_share = 1.0, finest = 0.02, bends_that_show = 0.1;
  constexpr double drafted = 0.03; // below it shadows take more rays than a draft's
  RunSettings settings = request.settings;
  settings.quality = request.goal.error.value_or(1.0) < drafted ? Quality::normal : Quality::draft;
  if (!settings.samples && !settings.pixel_error && settings.mode == PictureMode::hybrid)
    settings.pixel_error = request.goal.error ? pixel_share * *request.goal.error : finest;
  // A few small elements at the feet of lit walls cost little, and save dividing all.
  const bool gathers =
      settings.interpolation.value_or(Interpolation::gather) == Interpolation::gather;
  if (!settings.bends && gathers && mesh_cut(settings) == MeshCut::uniform)
    settings.bends = bends_that_show;
  return settings;
}

double Steering::spent() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double Steering::left() const {
  return request.goal.seconds ? *request.goal.seconds - request.reserve - request.spent - spent()
                              : std::numeric_limits<double>::infinity();
}

namespace {

/// Warnings are said once; a later run ends when the time does.
RunEvents events_of(Steering& steering, bool may_end) {
  RunEvents events;
  if (!steering.warned)
    events.warning = steering.events.warning;
  events.progress = [&steering, may_end](std::string_view stage, double fraction) {
    if (may_end && steering.left() < steering.estimate_seconds)
      throw OutOfTime{};
    if (steering.events.progress)
      steering.events.progress(stage, fraction);
  };
  return events;
}

/// Pass one as these parameters want it, unless it is there.
void light_scene(Steering& steering, const Parameters& parameters, const TwoPassSettings& settings,
                 const RunEvents& events) {
  // What was found for one view is finer where its term shows it.
  const auto for_term = [&](DiffuseTerm term) {
    TwoPassSettings other = settings;
    other.render.diffuse.term = term;
    return solves_for_view(*steering.lit->prepared, other);
  };
  if (steering.lit_with && steering.lit_with->elements == parameters.elements &&
      steering.lit_with->rays == parameters.rays &&
      (steering.lit_with->term == parameters.term || !for_term(DiffuseTerm::direct)))
    return;
  steering.view.reset();
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
  steering.lit_with = parameters;
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

/// Rays; those of the camera go through many pixels together, and cost a tenth.
double work_of(const RayCounts& rays) {
  constexpr double of_camera = 0.1;
  return double(rays.form_factor) + double(rays.shadow) + double(rays.specular) +
         of_camera * double(rays.camera);
}

/// The picture, by the view's field as it is where only samples change.
void show(Steering& steering, const Parameters& parameters, const RunSettings& settings,
          const RunEvents& events, SteeredRun& run) {
  const SteeringRequest& request = steering.request;
  auto& view = steering.view;
  if (view && parameters.term == DiffuseTerm::direct && settings.features.empty()) {
    RunSettings by_field = settings;
    by_field.diffuse = DiffuseTerm::interpolated;
    run.picture = render_view({steering.lit->prepared, *view->field}, request.camera, request.size,
                              by_field, events, run.figures);
    run.picture.finer = view->field;
    run.figures.rays.shadow += view->shadow_rays;
    return;
  }
  run.picture = render_view(*steering.lit, request.camera, request.size, settings, events, run.figures);
  if (run.picture.finer)
    steering.view = KeptView{run.picture.finer,
                             run.figures.rays.shadow - steering.figures.rays.shadow, 0.0};
}

/// What the run has cost, as if all of it had been made for it; and the view's field is kept.
void add_costs(Steering& steering, const PictureError& error, SteeredRun& run) {
  const RunSeconds& seconds = run.figures.seconds;
  const RayCounts &before = steering.figures.rays, &after = run.figures.rays;
  MeasuredRun& measured = run.measured;
  if (steering.counts_rays()) {
    measured.pass_one_cost = work_of(before);
    measured.pass_two_cost = work_of(after) - work_of(before);
    measured.estimate_cost = double(error.rays);
    measured.direct_cost = error.direct_rays;
    measured.gather_cost = error.gather_rays;
    return;
  }
  measured.pass_one_cost = seconds.plan + seconds.mesh + seconds.form_factors + seconds.solve +
                           seconds.interpolate;
  measured.pass_two_cost = seconds.render;
  if (steering.view && measured.parameters.term == DiffuseTerm::direct) {
    double& first = steering.view->seconds;
    if (first > 0.0)
      measured.pass_two_cost += first;
    else
      first = measured.pass_two_cost;
  }
  measured.estimate_cost = seconds.estimate;
  measured.direct_cost = error.direct_seconds;
  measured.gather_cost = error.gather_seconds;
}

} // namespace

SteeredRun run_with(Steering& steering, const Parameters& parameters, bool may_end) {
  const SteeringRequest& request = steering.request;
  const RunSettings settings = with_parameters(steering.settings, free_parameters(steering.settings), parameters);
  TwoPassSettings two_pass = two_pass_settings(settings);
  two_pass.render.width = request.size.width;
  two_pass.render.height = request.size.height;
  begin_stages(steering.events, picture_stages(settings, WithPassOne::yes));
  const RunEvents events = events_of(steering, may_end);
  light_scene(steering, parameters, two_pass, events);
  steering.warned = true;

  const LitScene& lit = *steering.lit;
  SteeredRun run{{}, steering.figures, {}};
  show(steering, parameters, settings, events, run);
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
  run.measured.parameters = parameters;
  add_costs(steering, error, run);
  run.measured.error = error;
  run.measured.pixels = double(request.size.width) * request.size.height;
  run.measured.divided = double(run.figures.solved_elements);
  run.measured.samples_a_pixel = mean_count(run.picture.samples, parameters.samples);
  run.measured.uncertain = uncertain_shares(run.picture.image, two_pass.render);
  return run;
}

} // namespace meninas
