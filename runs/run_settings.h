// What a user chooses about a run: a preset of quality, and explicit values that override it.
#pragma once

#include "raytrace/two_pass.h"

#include <optional>
#include <string>
#include <vector>

namespace meninas {

enum class Quality { draft, normal, fine };

/// The numbers a preset stands for.
struct QualityPreset {
  double target_elements = 0.0; ///< about how many elements share the meshed area
  int rays = 0; ///< form-factor rays per element, and per vertex where irradiance is gathered there
  int penumbra_rays = 0; ///< shadow rays from a vertex to an emitter that it sees in part
  int samples = 0;       ///< camera rays per pixel
};
QualityPreset preset_of(Quality quality);

struct PictureSize {
  int width = 512;
  int height = 512;
};

struct RunSettings {
  Quality quality = Quality::normal;
  std::optional<double> element_size; ///< metres
  FormFactorMethod form_factors = FormFactorMethod::rays;
  std::optional<int> rays;
  SolverMethod solver = SolverSettings{}.method;
  std::optional<double> tolerance;
  std::optional<int> mirror_depth; ///< no path meets more mirrors
  std::optional<Interpolation> interpolation;
  std::optional<int> samples;
  RenderMode mode = RenderMode::hybrid;
  int threads = 0; ///< 0: all the machine has
  std::uint32_t seed = 0;
};

/// Numbers of rays and samples are rounded up to powers of two.
TwoPassSettings two_pass_settings(const RunSettings& settings);

/// What was rounded, a sentence each.
std::vector<std::string> rounding_notes(const RunSettings& settings);

} // namespace meninas
