#include "runs/steering_model.h"

#include "runs/setting_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace meninas {

namespace {

constexpr double most_elements = 250'000.0;
constexpr int most_rays = 4096, least_samples = 4, most_samples = 1024;

/// What so many samples of a pixel take, in hits of their own: they share shadow rays (radiosity/shared_light.h).
double hits_of(int samples) { return samples <= 4 ? samples : std::max(4.0, 0.3 * samples); }

double pass_two_seconds(const MeasuredRun& run, const Knobs& knobs) {
  const double share = double(knobs.samples) / run.knobs.samples;
  if (knobs.term == run.knobs.term)
    return run.pass_two_seconds * (knobs.term == DiffuseTerm::interpolated
                                       ? share
                                       : hits_of(knobs.samples) / hits_of(run.knobs.samples));
  return share * run.pass_two_seconds +
         run.pixels * hits_of(knobs.samples) * run.error.direct_seconds;
}

std::vector<Knobs> turns(const Knobs& now, const FreeKnobs& free, const MeasuredRun& run) {
  std::vector<Knobs> all;
  const auto turn = [&](bool can, auto&& change) {
    if (can) {
      all.push_back(now);
      change(all.back());
    }
  };
  turn(free.elements && 2.0 * now.elements <= most_elements, [](Knobs& k) { k.elements *= 2.0; });
  turn(free.rays && 2 * now.rays <= most_rays, [](Knobs& k) { k.rays *= 2; });
  turn(free.samples && 4 * now.samples <= most_samples, [](Knobs& k) { k.samples *= 4; });
  // Camera rays that cost next to nothing so far are worth less where each computes light: fewer of them may do.
  const bool can_direct =
      free.term && now.term == DiffuseTerm::interpolated && run.error.direct_seconds > 0.0;
  for (const int fewer : {1, 4, 16})
    turn(can_direct && (fewer == 1 || (free.samples && now.samples / fewer >= least_samples)),
         [fewer](Knobs& k) {
           k.term = DiffuseTerm::direct;
           k.samples /= fewer;
         });
  return all;
}

/// "camera rays are 4.6 %: 16 samples a pixel", for every knob that was turned.
std::string reasons(const MeasuredRun& run, const Knobs& next) {
  const PictureError& e = run.error;
  std::vector<std::string> all;
  const auto because = [&](bool turned, const char* part, double error, std::string remedy) {
    if (turned)
      all.push_back(fmt::format("{} {:.2g} %: {}", part, 100.0 * error, remedy));
  };
  because(next.term != run.knobs.term, "edges within elements", e.mesh_direct,
          "light from the source at every hit");
  because(next.elements != run.knobs.elements, "mesh", e.mesh,
          fmt::format("about {:.0f} elements", next.elements));
  because(next.rays != run.knobs.rays, "form factors", e.form_factors,
          fmt::format("{} rays", next.rays));
  because(next.samples != run.knobs.samples, "camera rays", e.pixels,
          fmt::format("{} samples a pixel", next.samples));
  std::string text;
  for (const std::string& reason : all)
    text += (text.empty() ? "" : "; ") + reason;
  return text;
}

} // namespace

Forecast forecast(const MeasuredRun& run, const Knobs& knobs) {
  const PictureError& e = run.error;
  const double elements = knobs.elements / run.knobs.elements,
               rays = double(knobs.rays) / run.knobs.rays,
               samples = double(knobs.samples) / run.knobs.samples;
  const auto square = [](double x) { return x * x; };
  const double direct = square(e.mesh_direct), rest = std::max(square(e.mesh) - direct, 0.0);
  const bool edges = knobs.term == run.knobs.term; // or they have become exact
  const double squared = (edges ? direct * std::pow(elements, -0.5) : 0.0) + rest / elements +
                         square(e.form_factors) * std::pow(rays, -1.2) +
                         square(e.pixels) * std::pow(samples, -1.7) + square(e.mirror_tail) +
                         square(e.solver);
  constexpr double source_rays = 128.0; // that cost as much as light from the source
  const bool again = elements != 1.0 || rays != 1.0;
  const double pass_one = again ? run.pass_one_seconds * elements * (source_rays + knobs.rays) /
                                      (source_rays + run.knobs.rays)
                                : 0.0;
  const double per_ray = run.estimate_seconds * std::max(1.0, elements * rays);
  return {std::sqrt(squared),
          pass_one + pass_two_seconds(run, knobs) + (again ? per_ray : run.estimate_seconds)};
}

/// Knobs that were turned one after the other may be further than they need be together: back by single turns, those first that save most,
/// as long as the error is still foretold.
static NextRun turned_back(const MeasuredRun& run, NextRun next, double error) {
  for (;;) {
    const Knobs& now = next.knobs;
    std::vector<Knobs> all;
    const auto back = [&](bool can, auto&& change) {
      if (can) {
        all.push_back(now);
        change(all.back());
      }
    };
    back(now.elements > run.knobs.elements, [](Knobs& k) { k.elements /= 2.0; });
    back(now.rays > run.knobs.rays, [](Knobs& k) { k.rays /= 2; });
    back(now.samples > run.knobs.samples, [](Knobs& k) { k.samples /= 4; });
    std::optional<NextRun> best;
    for (const Knobs& knobs : all) {
      const Forecast then = forecast(run, knobs);
      if (then.error <= error && (!best || then.seconds < best->forecast.seconds))
        best = NextRun{knobs, then, {}};
    }
    if (!best)
      return next;
    next = *best;
  }
}

NextRun next_run(const MeasuredRun& run, const FreeKnobs& free, double error, double seconds) {
  NextRun next{run.knobs, forecast(run, run.knobs), {}};
  while (next.forecast.error > error) {
    std::optional<NextRun> best;
    double most = 0.0;
    for (const Knobs& knobs : turns(next.knobs, free, run)) {
      const Forecast then = forecast(run, knobs);
      if (then.seconds > seconds || !(then.error < next.forecast.error))
        continue;
      // What lies within what is done anyhow costs next to nothing.
      const double cost = std::max(then.seconds - next.forecast.seconds, 1e-4);
      const double gain = std::log(next.forecast.error / then.error) / cost;
      if (gain > most) {
        most = gain;
        best = NextRun{knobs, then, {}};
      }
    }
    if (!best)
      break;
    next = *best;
  }
  if (next.forecast.error <= error)
    next = turned_back(run, next, error);
  next.why = reasons(run, next.knobs);
  return next;
}

} // namespace meninas
