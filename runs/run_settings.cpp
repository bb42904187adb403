#include "runs/run_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace meninas {

static int power_of_two(int count) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(count)));
}

QualityPreset preset_of(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return {.target_elements = 2'250,
            .rays = 128,
            .hemicube_resolution = 32,
            .link_error = 0.02,
            .penumbra_rays = 32,
            .samples = 16,
            .hit_shadow_rays = 8,
            .shared_shadow_rays = 4,
            .pixel_penumbra_rays = 256,
            .max_error = 0.1,
            .root_elements = 600,
            .adaptive_error = 0.03};
  case Quality::normal:
    return {.target_elements = 16'000,
            .rays = 512,
            .hemicube_resolution = 64,
            .link_error = 0.01,
            .penumbra_rays = 128,
            .samples = 16,
            .hit_shadow_rays = 16,
            .shared_shadow_rays = 16,
            .pixel_penumbra_rays = 1024,
            .max_error = 0.03,
            .root_elements = 1'500,
            .adaptive_error = 0.01};
  case Quality::fine:
    return {.target_elements = 64'000,
            .rays = 2'048,
            .hemicube_resolution = 128,
            .link_error = 0.005,
            .penumbra_rays = 512,
            .samples = 64,
            .diffuse = DiffuseTerm::direct,
            .hit_shadow_rays = 16,
            .shared_shadow_rays = 16,
            .pixel_penumbra_rays = 1024,
            .max_error = 0.01,
            .root_elements = 5'000,
            .adaptive_error = 0.005};
  }
  return {};
}

bool tells_light_apart(const RunSettings& settings) {
  return settings.form_factors != FormFactorMethod::analytic ||
         settings.interpolation != Interpolation::average;
}

DiffuseTerm diffuse_term(const RunSettings& settings) {
  if (settings.mode == PictureMode::radiosity)
    return DiffuseTerm::interpolated;
  const DiffuseTerm preset = preset_of(settings.quality).diffuse;
  return settings.diffuse.value_or(tells_light_apart(settings) ? preset
                                                               : DiffuseTerm::interpolated);
}

/// A pixel's rays are shared out among its samples;
/// where sampling is adaptive, most pixels have few.
static DiffuseSettings diffuse_settings(const RunSettings& settings,
                                        const FormFactorSettings& form_factors, int samples) {
  constexpr int gather_rays = 2048, least = 16; // of a pixel; of a sample
  constexpr int shared_at_most = 32;
  if (settings.pixel_error)
    samples = std::min(samples, shared_at_most);
  const QualityPreset preset = preset_of(settings.quality);
  DiffuseSettings result;
  result.term = diffuse_term(settings);
  result.direct.seed = settings.seed;
  result.direct.shadow_rays = preset.hit_shadow_rays;
  result.shared_shadow_rays = preset.shared_shadow_rays;
  result.direct.penumbra_rays =
      std::max(settings.pixel_error ? 1 : least, preset.pixel_penumbra_rays / samples);
  result.gather = form_factors;
  result.gather.method = FormFactorMethod::rays;
  result.points.rays = std::max(least, gather_rays / samples);
  return result;
}

TwoPassSettings two_pass_settings(const RunSettings& settings) {
  const QualityPreset preset = preset_of(settings.quality);
  TwoPassSettings result;
  PassOneSettings& pass_one = result.pass_one;
  pass_one.mesh.element_size = settings.element_size.value_or(0.0);
  // What the analytic method takes grows with the square of the elements.
  constexpr double few_elements = 500.0;
  const bool adaptive = settings.adaptive == WithAdaptivity::yes;
  pass_one.mesh.target_elements = adaptive ? preset.root_elements : preset.target_elements;
  if (settings.form_factors == FormFactorMethod::analytic) {
    pass_one.mesh.target_elements = std::min(pass_one.mesh.target_elements, few_elements);
  }
  if (settings.elements) {
    pass_one.mesh.target_elements = *settings.elements;
  }
  pass_one.form_factors.method = settings.form_factors;
  pass_one.form_factors.rays = power_of_two(settings.rays.value_or(preset.rays));
  pass_one.form_factors.hemicube_resolution =
      settings.hemicube_resolution.value_or(preset.hemicube_resolution);
  pass_one.form_factors.seed = settings.seed;
  pass_one.direct.seed = settings.seed;
  pass_one.direct.penumbra_rays = preset.penumbra_rays;
  pass_one.solver.method = settings.solver;
  pass_one.solver.tolerance = settings.tolerance.value_or(pass_one.solver.tolerance);
  pass_one.solver.max_shots = settings.steps;
  pass_one.hierarchical.link_error = settings.link_error.value_or(preset.link_error);
  pass_one.interpolation.method = settings.interpolation.value_or(pass_one.interpolation.method);
  // Means of elements show nowhere but where they are interpolated; else they light other elements,
  // and many average out. Few and large ones, between which an adaptive field gathers, do not.
  if (pass_one.interpolation.method == Interpolation::gather && !adaptive) {
    pass_one.direct.points = 4;
    pass_one.direct.most_points = 64;
  }
  pass_one.interpolation.rays = pass_one.form_factors.rays;
  pass_one.interpolation.bend = settings.bends.value_or(0.0);
  // Edges are few: what they are off by counts less than what all light is, and the more so
  // the closer that is looked at. At hits direct light has no vertices.
  constexpr double of_edges = 0.02;
  if (settings.solver == SolverMethod::hierarchical &&
      diffuse_term(settings) == DiffuseTerm::interpolated)
    pass_one.interpolation.shadow_bend = std::sqrt(of_edges * pass_one.hierarchical.link_error);
  if (adaptive) {
    pass_one.interpolation.adaptive =
        AdaptiveSettings{.error = settings.adaptive_error.value_or(preset.adaptive_error)};
  }

  result.render.mode =
      settings.mode == PictureMode::radiosity ? RenderMode::radiosity : RenderMode::hybrid;
  result.render.samples = power_of_two(settings.samples.value_or(preset.samples));
  result.render.seed = settings.seed;
  result.render.layers = settings.layers;
  result.render.features = settings.features;
  result.render.filter = settings.filter;
  result.render.pixel_error = settings.pixel_error.value_or(0.0);
  result.render.glossy_samples = settings.glossy_samples.value_or(result.render.glossy_samples);
  result.render.diffuse = diffuse_settings(settings, pass_one.form_factors, result.render.samples);
  if (settings.mirror_depth) {
    // A cap holds for every kind of path: in closed form, gathered, and seen by the camera.
    pass_one.plan.worlds.max_depth =
        std::min(pass_one.plan.worlds.max_depth, *settings.mirror_depth);
    pass_one.form_factors.max_bounces = *settings.mirror_depth;
    result.render.max_bounces = *settings.mirror_depth;
    result.render.diffuse.gather.max_bounces = *settings.mirror_depth;
  }
  return result;
}

/// Whole batches, at least two: one says nothing about its variance.
static int whole_batches(int samples) {
  constexpr int batch = reference::batch_samples;
  return std::max(2, (samples + batch - 1) / batch) * batch;
}

reference::ReferenceSettings reference_settings(const RunSettings& settings) {
  reference::ReferenceSettings result;
  result.seed = settings.seed;
  result.layers = settings.layers;
  result.max_error = settings.max_error.value_or(0.0);
  result.max_seconds = settings.max_seconds.value_or(result.max_seconds);
  if (settings.samples) {
    result.max_samples = whole_batches(*settings.samples);
  }
  if (!settings.samples && !settings.max_error && !settings.max_seconds) {
    result.max_error = preset_of(settings.quality).max_error;
  }
  return result;
}

std::vector<std::string> rounding_notes(const RunSettings& settings) {
  std::vector<std::string> notes;
  if (settings.mode == PictureMode::reference) {
    if (settings.samples && whole_batches(*settings.samples) != *settings.samples) {
      notes.push_back(fmt::format("--samples {} is rounded up to {}", *settings.samples,
                                  whole_batches(*settings.samples)));
    }
    return notes;
  }
  const auto compare = [&](const char* option, const std::optional<int>& asked) {
    if (asked && power_of_two(*asked) != *asked) {
      notes.push_back(
          fmt::format("{} {} is rounded up to {}", option, *asked, power_of_two(*asked)));
    }
  };
  compare("--rays", settings.rays);
  compare("--samples", settings.samples);
  return notes;
}

} // namespace meninas
