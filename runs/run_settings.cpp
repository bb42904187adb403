#include "runs/run_settings.h"

#include "raytrace/pixels/picture_window.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

static double reference_error(Quality quality) {
  switch (quality) {
  case Quality::draft:
    return 0.1;
  case Quality::normal:
    return 0.03;
  case Quality::fine:
    return 0.01;
  }
  return 0.0;
}

QualityPreset preset_of(Quality quality) {
  return {pass_one_quality(quality), render_quality(quality), reference_error(quality)};
}

static RenderMode render_mode(const RunSettings& settings) {
  return settings.mode == PictureMode::radiosity ? RenderMode::radiosity : RenderMode::hybrid;
}

DiffuseTerm diffuse_term(const RunSettings& settings) {
  return diffuse_term(settings, render_mode(settings));
}

TwoPassSettings two_pass_settings(const RunSettings& settings) {
  return two_pass_settings(settings, render_mode(settings));
}

RunSettings settled(RunSettings settings, const LightScene& light, bool knows_indirect) {
  if (!settings.diffuse && (!knows_indirect || !tells_light_apart(settings)))
    settings.diffuse = DiffuseTerm::interpolated;
  if (!settings.diffuse && light.finely_tessellated)
    settings.diffuse = DiffuseTerm::direct;
  return settings;
}

RenderSettings render_settings(const RunSettings& settings, PictureSize size) {
  RenderSettings render = two_pass_settings(settings).render;
  render.width = size.width;
  render.height = size.height;
  if (settings.part) {
    const int most = max_parts(size.width, size.height);
    if (settings.part->count > most)
      throw UsageError("--tile", fmt::format("a picture of {}x{} pixels has no more than {} parts",
                                             size.width, size.height, most));
    render.window = window_of_part(size.width, size.height, settings.part->number,
                                   settings.part->count);
  }
  return render;
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
