#include "runs/steering/steering_model.h"

#include "runs/steering/setting_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace meninas {

namespace {

constexpr double max_elements = 250'000.0;
constexpr int max_rays = 4096, max_samples = 1024;

/// first, growth times as many, and so on up to `most`; where it is not free, the first alone.
std::vector<double> steps_up(bool free, double first, double growth, double most) {
  std::vector<double> steps{first};
  while (free && growth * steps.back() <= most)
    steps.push_back(growth * steps.back());
  return steps;
}

/// Light computed at hits takes the place of the field's where it is known what it takes.
std::vector<DiffuseTerm> terms(const MeasuredRun& run, const FreeParameters& free) {
  std::vector<DiffuseTerm> all{run.parameters.term};
  if (!free.term)
    return all;
  if (run.parameters.term == DiffuseTerm::interpolated && run.direct_cost > 0.0)
    all.push_back(DiffuseTerm::direct);
  // It is the dearest by far, and trusts what elements reflect: for where meshes do not help.
  constexpr double does_not_help = 0.7; // the exponent
  if (run.parameters.term != DiffuseTerm::gather && run.gather_cost > 0.0 &&
      (!free.elements || run.mesh_exponent < does_not_help))
    all.push_back(DiffuseTerm::gather);
  return all;
}

/// All that may be tried next.
std::vector<Parameters> parameters_after(const MeasuredRun& run, const FreeParameters& free) {
  constexpr double max_growth = 16.0; // how the mesh's error falls is not known further than that
  const Parameters& now = run.parameters;
  const double finest = std::min(max_elements, max_growth * now.elements);
  std::vector<Parameters> all;
  for (const DiffuseTerm term : terms(run, free))
    for (const double elements : steps_up(free.elements, now.elements, 2.0, finest))
      for (const double rays : steps_up(free.rays, now.rays, 2.0, max_rays)) {
        // Camera rays that cost next to nothing so far are worth less where each computes light.
        double fewest = now.samples;
        while (free.samples && term != now.term && fewest / 4.0 >= min_samples)
          fewest /= 4.0;
        for (const double samples : steps_up(free.samples, fewest, 4.0, max_samples))
          all.push_back({elements, static_cast<int>(rays), static_cast<int>(samples), term});
      }
  return all;
}

/// "camera rays are 4.6 %: 16 samples a pixel", for every parameter that was turned.
std::string reasons(const MeasuredRun& run, const Parameters& next) {
  const PictureError& e = run.error;
  std::vector<std::string> all;
  const auto because = [&](bool turned, const char* part, double error, std::string remedy) {
    if (turned)
      all.push_back(fmt::format("{} {:.2g} %: {}", part, 100.0 * error, remedy));
  };
  because(next.term == DiffuseTerm::direct && next.term != run.parameters.term, "edges within elements",
          e.mesh_direct, "direct light at every hit");
  because(next.term == DiffuseTerm::gather && next.term != run.parameters.term, "mesh and form factors",
          std::hypot(e.mesh, e.form_factors), "light gathered at every hit");
  because(next.elements != run.parameters.elements, "mesh", e.mesh,
          fmt::format("about {:.0f} elements", next.elements));
  because(next.rays != run.parameters.rays, "form factors", e.form_factors,
          fmt::format("{} rays", next.rays));
  because(next.samples != run.parameters.samples, "camera rays", e.pixels,
          fmt::format("{} samples a pixel", next.samples));
  std::string text;
  for (const std::string& reason : all)
    text += (text.empty() ? "" : "; ") + reason;
  return text;
}

} // namespace

NextRun next_run(const MeasuredRun& run, const FreeParameters& free, double error, double cost) {
  constexpr double as_good = 1.01;
  const NextRun same{run.parameters, forecast(run, run.parameters), {}};
  if (same.forecast.error <= error)
    return same;
  std::vector<NextRun> better;
  double least = same.forecast.error;
  for (const Parameters& parameters : parameters_after(run, free)) {
    const Forecast then = forecast(run, parameters);
    if (then.cost > cost || !(then.error < same.forecast.error))
      continue;
    better.push_back({parameters, then, {}});
    least = std::min(least, then.error);
  }
  // The quickest of those that do, or that are as good as any.
  NextRun next = same;
  for (const NextRun& other : better)
    if (other.forecast.error <= std::max(error, as_good * least) &&
        (next.parameters == run.parameters || other.forecast.cost < next.forecast.cost))
      next = other;
  next.why = reasons(run, next.parameters);
  return next;
}

FreeParameters worth_changing(FreeParameters free, const MeasuredRun& before, const MeasuredRun& turned) {
  const Parameters &was = before.parameters, &is = turned.parameters;
  const auto helped = [&](double PictureError::*part) {
    return turned.error.*part < before.error.*part;
  };
  free.elements = free.elements && (is.elements == was.elements || helped(&PictureError::mesh));
  free.rays = free.rays && (is.rays == was.rays || helped(&PictureError::form_factors));
  free.samples = free.samples && (is.samples == was.samples || helped(&PictureError::pixels));
  free.term = free.term && (is.term == was.term || is.term != DiffuseTerm::gather);
  return free;
}

} // namespace meninas
