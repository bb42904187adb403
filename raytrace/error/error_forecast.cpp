#include "raytrace/error/error_forecast.h"

#include "raytrace/views/view_light.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

// Exponents: of pixels whose light is a smooth function between edges, and of what rays gather.
constexpr double at_edges = 1.7, of_noise = 1.1;
constexpr double rays_of_a_hit = 64.0; ///< of a hit that gathers, where sampling is adaptive

/// So many samples of a pixel take as long as the vertices of a field that is made for the view.
constexpr double samples_of_vertices = 200.0;

/// Samples of a pixel in the mean.
double samples_a_pixel(const MeasuredRun& run, int samples) {
  double mean = std::min(run.samples_a_pixel, double(samples));
  std::size_t round = 0;
  for (int taken = run.parameters.samples; taken < samples; taken *= 4)
    mean += run.uncertain[std::min(round++, run.uncertain.size() - 1)] * 3.0 * taken;
  return mean;
}

/// The factor on the squared error of camera rays;
/// nothing is left to gain where no pixel would take more.
double pixel_decline(const MeasuredRun& run, const Parameters& parameters) {
  const int samples = parameters.samples;
  const double exponent = parameters.term == DiffuseTerm::gather ? of_noise : at_edges;
  if (samples < run.parameters.samples)
    return std::pow(samples_a_pixel(run, samples) / run.samples_a_pixel, -exponent);
  double decline = 1.0;
  std::size_t round = 0;
  for (int taken = run.parameters.samples; taken < samples; taken *= 4)
    decline *= run.uncertain[std::min(round++, run.uncertain.size() - 1)] > 0.0
                   ? std::pow(4.0, -exponent)
                   : 1.0;
  return decline;
}

/// The cost of one hit that gathers with rays of its own.
double gather_hit_cost(const MeasuredRun& run) {
  constexpr double source_rays = 128.0; // that cost as much as direct light
  return run.gather_cost * (source_rays + rays_of_a_hit) / (source_rays + run.parameters.rays);
}

/// Whether elements or rays change.
bool solves_again(const MeasuredRun& run, const Parameters& parameters) {
  return parameters.elements != run.parameters.elements || parameters.rays != run.parameters.rays;
}

double pass_two_cost(const MeasuredRun& run, const Parameters& parameters) {
  const double samples = samples_a_pixel(run, parameters.samples);
  const double share = samples / run.samples_a_pixel;
  if (parameters.term == run.parameters.term)
    return run.pass_two_cost *
           (parameters.term == DiffuseTerm::direct
                ? (solves_again(run, parameters) ? samples_of_vertices + samples : samples) /
                      (samples_of_vertices + run.samples_a_pixel)
                : share);
  const double hits = run.pixels * (parameters.term == DiffuseTerm::direct
                                        ? vertices_of_a_pixel * run.direct_cost
                                        : samples * gather_hit_cost(run));
  return share * run.pass_two_cost + hits;
}

/// Samples drawn again to find out, of a pixel that is looked at:
/// as many pixels of each number of samples, more of those of few (raytrace/error/picture_error.cpp).
double samples_drawn_again(int samples) {
  constexpr int min_drawn = 16, max_rounds = 64; // first samples to last
  double drawn = 0.0, groups = 0.0;
  for (int n = std::max(min_samples, samples / max_rounds); n <= samples; n *= 4) {
    drawn += std::max(n, min_drawn);
    groups += 1.0;
  }
  return groups > 0.0 ? drawn / groups : min_drawn;
}

/// The cost of estimating the error.
double estimate_cost(const MeasuredRun& run, const Parameters& parameters) {
  constexpr double of_camera_rays = 1.0 / 3.0; // the share drawn again, with four samples a pixel
  constexpr double source_rays = 128.0;        // that cost as much as direct light
  const auto pixels = [](double elements) {
    return error_settings(TwoPassSettings{}, static_cast<std::size_t>(elements)).gathered_pixels;
  };
  const auto of_a_pixel = [](const Parameters& k) {
    return (1.0 - of_camera_rays) * (source_rays + k.rays) / (source_rays + Parameters{}.rays) +
           of_camera_rays * samples_drawn_again(k.samples) /
               samples_drawn_again(Parameters{}.samples);
  };
  return run.estimate_cost * pixels(parameters.elements) / pixels(run.parameters.elements) *
         of_a_pixel(parameters) / of_a_pixel(run.parameters);
}

} // namespace

/// Whether elements were divided about as often as they were wanted to be. Small surfaces are
/// elements as they are, and to ask for twice as many may divide next to nothing.
static bool tells_of_division(const MeasuredRun& coarse, const MeasuredRun& fine) {
  constexpr double share = 0.5; // of the growth that was wanted, in logarithms
  return std::log(fine.divided / coarse.divided) >=
         share * std::log(fine.parameters.elements / coarse.parameters.elements);
}

double measured_mesh_exponent(const MeasuredRun& coarse, const MeasuredRun& fine) {
  const auto square = [](double x) { return x * x; };
  const auto rest = [&](const MeasuredRun& run) {
    return square(run.error.mesh) - square(run.error.mesh_direct);
  };
  // Where the error is nearly all edges, the difference is below the accuracy of both.
  constexpr double known = 0.25;
  for (const MeasuredRun* run : {&coarse, &fine})
    if (!(rest(*run) > known * square(run->error.mesh)))
      return coarse.mesh_exponent;
  if (!tells_of_division(coarse, fine))
    return coarse.mesh_exponent;
  const double growth = std::log(fine.divided / coarse.divided);
  return std::clamp(std::log(rest(coarse) / rest(fine)) / growth, 0.0, 1.0);
}

/// The squared error of the field.
static double field_error(const MeasuredRun& run, const Parameters& parameters) {
  const PictureError& e = run.error;
  const auto square = [](double x) { return x * x; };
  const double elements = parameters.elements / run.parameters.elements,
               rays = double(parameters.rays) / run.parameters.rays;
  if (parameters.term == DiffuseTerm::gather) {
    if (run.parameters.term == DiffuseTerm::gather)
      return square(e.mesh) * std::pow(elements, -run.mesh_exponent);
    constexpr double noise_of_interpolated =
        4.0 / 9.0; // of a vertex's: raytrace/error/picture_error.h
    return square(e.form_factors) / noise_of_interpolated *
           std::pow(run.parameters.rays / rays_of_a_hit, 1.2) / samples_a_pixel(run, parameters.samples);
  }
  // Edges stay, or become exact.
  // If the whole is hardly more than they are, the rest is not known to less than a share of them.
  constexpr double unknown = 0.1;
  const bool edges = parameters.term == run.parameters.term;
  const double direct = square(e.mesh_direct);
  const double rest =
      std::max(square(e.mesh) - direct, edges ? 0.0 : square(unknown * e.mesh_direct));
  return (edges ? direct * std::pow(elements, -0.5) : 0.0) +
         rest * std::pow(elements, -run.mesh_exponent) +
         square(e.form_factors) * std::pow(rays, -1.2) + square(e.mirror_tail);
}

Forecast forecast(const MeasuredRun& run, const Parameters& parameters) {
  const PictureError& e = run.error;
  const double elements = parameters.elements / run.parameters.elements;
  const auto square = [](double x) { return x * x; };
  const double squared =
      field_error(run, parameters) + square(e.pixels) * pixel_decline(run, parameters) + square(e.solver);
  constexpr double source_rays = 128.0; // that cost as much as direct light
  constexpr double of_elements = 0.7;
  const double pass_one = solves_again(run, parameters)
                              ? run.pass_one_cost * std::pow(elements, of_elements) *
                                    (source_rays + parameters.rays) / (source_rays + run.parameters.rays)
                              : 0.0;
  const double estimate = estimate_cost(run, parameters);
  return {std::sqrt(squared), pass_one + pass_two_cost(run, parameters) + estimate, estimate};
}

} // namespace meninas
