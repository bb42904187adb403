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

// Exponents: of pixels whose light is a smooth function between edges, of light from the source, and of what rays gather.
constexpr double at_edges = 1.7, of_shadows = 1.4, of_noise = 1.1;
constexpr double rays_of_a_hit = 64.0; ///< of a hit that gathers, where sampling is adaptive

/// What so many samples of a pixel take, in hits of their own: they share shadow rays (radiosity/shared_light.h).
double hits_of(double samples) { return samples <= 4.0 ? samples : 4.0 + 0.3 * (samples - 4.0); }

/// Samples of a pixel in the mean.
double samples_a_pixel(const MeasuredRun& run, int samples) {
  double mean = std::min(run.samples_a_pixel, double(samples));
  std::size_t round = 0;
  for (int taken = run.knobs.samples; taken < samples; taken *= 4)
    mean += run.uncertain[std::min(round++, run.uncertain.size() - 1)] * 3.0 * taken;
  return mean;
}

/// Of the square of what camera rays are off by; nothing is left to gain where no pixel would take more.
double pixel_decline(const MeasuredRun& run, const Knobs& knobs) {
  const int samples = knobs.samples;
  const double exponent = knobs.term == DiffuseTerm::interpolated ? at_edges
                          : knobs.term == DiffuseTerm::direct     ? of_shadows
                                                                  : of_noise;
  if (samples < run.knobs.samples)
    return std::pow(samples_a_pixel(run, samples) / run.samples_a_pixel, -exponent);
  double decline = 1.0;
  std::size_t round = 0;
  for (int taken = run.knobs.samples; taken < samples; taken *= 4)
    decline *= run.uncertain[std::min(round++, run.uncertain.size() - 1)] > 0.0
                   ? std::pow(4.0, -exponent)
                   : 1.0;
  return decline;
}

/// What one hit takes that gathers with rays of its own.
double gather_seconds(const MeasuredRun& run) {
  constexpr double source_rays = 128.0; // that cost as much as light from the source
  return run.error.gather_seconds * (source_rays + rays_of_a_hit) / (source_rays + run.knobs.rays);
}

double pass_two_seconds(const MeasuredRun& run, const Knobs& knobs) {
  const double samples = samples_a_pixel(run, knobs.samples);
  const double share = samples / run.samples_a_pixel;
  if (knobs.term == run.knobs.term)
    return run.pass_two_seconds * (knobs.term == DiffuseTerm::direct
                                       ? hits_of(samples) / hits_of(run.samples_a_pixel)
                                       : share);
  const double hits =
      run.pixels * (knobs.term == DiffuseTerm::direct ? hits_of(samples) * run.error.direct_seconds
                                                      : samples * gather_seconds(run));
  return share * run.pass_two_seconds + hits;
}

std::vector<Knobs> turns(const Knobs& now, const FreeKnobs& free, const MeasuredRun& run) {
  std::vector<Knobs> all;
  const auto turn = [&](bool can, auto&& change) {
    if (can) {
      all.push_back(now);
      change(all.back());
    }
  };
  constexpr double most_growth = 16.0; // how the mesh's error falls is not known further than that
  turn(free.elements &&
           2.0 * now.elements <= std::min(most_elements, most_growth * run.knobs.elements),
       [](Knobs& k) { k.elements *= 2.0; });
  turn(free.rays && 2 * now.rays <= most_rays, [](Knobs& k) { k.rays *= 2; });
  turn(free.samples && 4 * now.samples <= most_samples, [](Knobs& k) { k.samples *= 4; });
  // Camera rays that cost next to nothing so far are worth less where each computes light: as few of them as do, first of all. So may be what has
  // been turned in pass one, which must not keep such light out of the time.
  const auto turn_term = [&](bool can, DiffuseTerm term) {
    for (const bool as_it_was : {true, false})
      for (const int fewer : {256, 64, 16, 4, 1})
        turn(free.term && can &&
                 (fewer == 1 || (free.samples && now.samples / fewer >= least_samples)),
             [&](Knobs& k) {
               k.term = term;
               k.samples /= fewer;
               if (as_it_was) {
                 k.elements = run.knobs.elements;
                 k.rays = run.knobs.rays;
               }
             });
  };
  turn_term(now.term == DiffuseTerm::interpolated && run.error.direct_seconds > 0.0,
            DiffuseTerm::direct);
  // It is the dearest by far, and trusts what elements reflect: for where meshes do not help.
  constexpr double does_not_help = 0.7; // the exponent
  turn_term(now.term != DiffuseTerm::gather && run.error.gather_seconds > 0.0 &&
                (!free.elements || run.mesh_exponent < does_not_help),
            DiffuseTerm::gather);
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
  because(next.term == DiffuseTerm::direct && next.term != run.knobs.term, "edges within elements",
          e.mesh_direct, "light from the source at every hit");
  because(next.term == DiffuseTerm::gather && next.term != run.knobs.term, "mesh and form factors",
          std::hypot(e.mesh, e.form_factors), "light gathered at every hit");
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

double measured_mesh_exponent(const MeasuredRun& coarse, const MeasuredRun& fine) {
  const auto square = [](double x) { return x * x; };
  const auto rest = [&](const MeasuredRun& run) {
    return square(run.error.mesh) - square(run.error.mesh_direct);
  };
  // Where nearly all is edges the difference is what neither is known to.
  constexpr double known = 0.25;
  for (const MeasuredRun* run : {&coarse, &fine})
    if (!(rest(*run) > known * square(run->error.mesh)))
      return coarse.mesh_exponent;
  const double growth = std::log(fine.knobs.elements / coarse.knobs.elements);
  return std::clamp(std::log(rest(coarse) / rest(fine)) / growth, 0.0, 1.0);
}

/// What the field is off by, squared.
static double field_error(const MeasuredRun& run, const Knobs& knobs) {
  const PictureError& e = run.error;
  const auto square = [](double x) { return x * x; };
  const double elements = knobs.elements / run.knobs.elements,
               rays = double(knobs.rays) / run.knobs.rays;
  if (knobs.term == DiffuseTerm::gather) {
    if (run.knobs.term == DiffuseTerm::gather)
      return 0.0;
    constexpr double noise_of_interpolated = 4.0 / 9.0; // of a vertex's: raytrace/picture_error.h
    return square(e.form_factors) / noise_of_interpolated *
           std::pow(run.knobs.rays / rays_of_a_hit, 1.2) / samples_a_pixel(run, knobs.samples);
  }
  // Edges stay, or become exact. Of what is hardly more than they are, the rest is not known to less than a share of them.
  constexpr double unknown = 0.1;
  const bool edges = knobs.term == run.knobs.term;
  const double direct = square(e.mesh_direct);
  const double rest =
      std::max(square(e.mesh) - direct, edges ? 0.0 : square(unknown * e.mesh_direct));
  return (edges ? direct * std::pow(elements, -0.5) : 0.0) +
         rest * std::pow(elements, -run.mesh_exponent) +
         square(e.form_factors) * std::pow(rays, -1.2) + square(e.mirror_tail);
}

Forecast forecast(const MeasuredRun& run, const Knobs& knobs) {
  const PictureError& e = run.error;
  const double elements = knobs.elements / run.knobs.elements,
               rays = double(knobs.rays) / run.knobs.rays;
  const auto square = [](double x) { return x * x; };
  const double squared =
      field_error(run, knobs) + square(e.pixels) * pixel_decline(run, knobs) + square(e.solver);
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
  // Where the time has ended it, what was turned for next to nothing goes back as well.
  constexpr double as_good = 1.01;
  if (next.knobs != run.knobs)
    next = turned_back(run, next, std::max(error, as_good * next.forecast.error));
  next.why = reasons(run, next.knobs);
  return next;
}

} // namespace meninas
