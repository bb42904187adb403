#include "raytrace/two_pass_settings.h"

#include <algorithm>

namespace meninas {

RenderQuality render_quality(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return {.samples = 16,
            .min_samples = 16,
            .hit_shadow_rays = 8,
            .pixel_penumbra_rays = 256,
            .vertex_penumbra_rays = 64,
            .cell_tolerance = 0.04,
            .finest_cell = 0.2};
  case Quality::normal:
    return {.samples = 256,
            .min_samples = 16,
            .pixel_error = 0.05,
            .diffuse = DiffuseTerm::direct,
            .hit_shadow_rays = 16,
            .pixel_penumbra_rays = 1024,
            .vertex_penumbra_rays = 128,
            .cell_tolerance = 0.02,
            .finest_cell = 0.2};
  case Quality::fine:
    return {.samples = 1024,
            .min_samples = 64,
            .pixel_error = 0.02,
            .diffuse = DiffuseTerm::direct,
            .hit_shadow_rays = 16,
            .pixel_penumbra_rays = 1024,
            .vertex_penumbra_rays = 512,
            .cell_tolerance = 0.01,
            .finest_cell = 0.1};
  }
  return {};
}

bool tells_light_apart(const PassOneChoice& choice) {
  return choice.form_factors != FormFactorMethod::analytic ||
         choice.interpolation != Interpolation::average;
}

DiffuseTerm diffuse_term(const TwoPassChoice& choice, RenderMode mode) {
  if (mode == RenderMode::radiosity)
    return DiffuseTerm::interpolated;
  return choice.diffuse.value_or(tells_light_apart(choice) ? render_quality(choice.quality).diffuse
                                                           : DiffuseTerm::interpolated);
}

/// Adaptive where the user asks for it, or leaves the samples to the quality.
static void choose_samples(const TwoPassChoice& choice, RenderSettings& render) {
  const RenderQuality quality = render_quality(choice.quality);
  render.samples = power_of_two(choice.samples.value_or(quality.samples));
  if (choice.pixel_error) {
    render.pixel_error = *choice.pixel_error;
  } else if (!choice.samples) {
    render.pixel_error = quality.pixel_error;
    render.min_samples = quality.min_samples;
  }
}

/// The samples of most pixels: where sampling is adaptive, few.
static int usual_samples(const TwoPassChoice& choice, const RenderSettings& render) {
  constexpr int max_usual = 32;
  if (choice.pixel_error)
    return std::min(render.samples, max_usual);
  return render.pixel_error > 0.0 ? render.min_samples : render.samples;
}

/// A pixel's rays are shared out among its samples.
static DiffuseSettings diffuse_settings(const TwoPassChoice& choice, DiffuseTerm term,
                                        const FormFactorSettings& form_factors, int samples) {
  constexpr int gather_rays = 2048, least = 16; // of a pixel; of a sample
  const RenderQuality quality = render_quality(choice.quality);
  DiffuseSettings result;
  result.term = term;
  result.direct.seed = choice.seed;
  result.direct.shadow_rays = quality.hit_shadow_rays;
  result.refinement.seed = choice.seed;
  result.refinement.penumbra_rays = quality.vertex_penumbra_rays;
  result.refinement.tolerance = quality.cell_tolerance;
  result.refinement.finest = quality.finest_cell;
  result.direct.penumbra_rays =
      std::max(choice.pixel_error ? 1 : least, quality.pixel_penumbra_rays / samples);
  result.gather = form_factors;
  result.gather.method = FormFactorMethod::rays;
  result.points.rays = std::max(least, gather_rays / samples);
  return result;
}

TwoPassSettings two_pass_settings(const TwoPassChoice& choice, RenderMode mode) {
  const DiffuseTerm term = diffuse_term(choice, mode);
  TwoPassSettings result;
  result.pass_one = pass_one_settings(choice);
  RenderSettings& render = result.render;
  render.mode = mode;
  choose_samples(choice, render);
  render.seed = choice.seed;
  render.display = choice.display;
  render.layers = choice.layers;
  render.features = choice.features;
  render.filter = choice.filter;
  render.glossy_samples = choice.glossy_samples.value_or(render.glossy_samples);
  render.diffuse = diffuse_settings(choice, term, result.pass_one.form_factors, usual_samples(choice, render));
  // A cap on mirrors holds for what the camera sees as for light.
  render.max_bounces = choice.mirror_depth.value_or(render.max_bounces);
  return result;
}

} // namespace meninas
