// What a user chooses about a run: a preset of quality, and explicit values that override it.
#pragma once

#include "raytrace/views/debug_view.h"
#include "raytrace/two_pass.h"
#include "reference/reference_picture.h"
#include "scenes/gltf/gltf.h"

#include <optional>
#include <string>
#include <vector>

namespace meninas {

enum class Quality { draft, normal, fine };

/// Whether elements are divided where the light asks for it.
enum class WithAdaptivity { no, yes };

/// The numbers a preset stands for.
struct QualityPreset {
  double target_elements = 0.0; ///< about how many elements share the meshed area
  int rays = 0; ///< form-factor rays per element, and per vertex where irradiance is gathered there
  int hemicube_resolution = 0; ///< cells along an edge of the top, where hemicubes are used instead
  double link_error = 0.0; ///< of the hierarchical solver: how much light may bend where it is interpolated
  int penumbra_rays = 0;   ///< shadow rays from a vertex to an emitter that it sees in part
  int samples = 0;            ///< camera rays per pixel
  DiffuseTerm diffuse = DiffuseTerm::interpolated; ///< of a hybrid picture
  int hit_shadow_rays = 0;    ///< from a hit to an emitter, where light is computed there
  int shared_shadow_rays = 0; ///< likewise, to begin with, from each of a pixel's hits that share them
  int pixel_penumbra_rays =
      0; ///< likewise, where the first ones disagree, shared out among a pixel's samples
  double max_error = 0.0;     ///< of a reference: relative standard error of the picture
  double root_elements = 0.0; ///< instead of `target_elements` where elements are divided as needed
  double adaptive_error = 0.0; ///< of radiosity, relative, in the mean square, where they are
};
QualityPreset preset_of(Quality quality);

struct PictureSize {
  int width = 512;
  int height = 512;
};

/// How a picture is made.
enum class PictureMode {
  radiosity, ///< pass one alone: mirrors are black
  hybrid,    ///< both passes
  reference  ///< path tracing, which shares nothing with them
};

struct RunSettings {
  GltfSettings gltf; ///< how the scene's file is read
  Quality quality = Quality::normal;
  std::optional<double> element_size; ///< metres, of all surfaces
  std::optional<int> elements;        ///< or about so many, shared over them (element_sizes.h)
  WithAdaptivity adaptive = WithAdaptivity::no;
  std::optional<double> adaptive_error;
  std::optional<double> bends; ///< of the mean: elements in which light bends by more are divided
  FormFactorMethod form_factors = FormFactorMethod::rays;
  std::optional<int> rays;
  std::optional<int> hemicube_resolution; ///< even
  SolverMethod solver = SolverSettings{}.method;
  std::optional<double> tolerance;
  std::optional<int> steps;         ///< of the progressive solver: shots
  std::optional<double> link_error; ///< of the hierarchical solver
  std::optional<int> mirror_depth;  ///< no path meets more mirrors
  std::optional<Interpolation> interpolation;
  std::optional<int> samples;
  PictureMode mode = PictureMode::hybrid;
  std::optional<DiffuseTerm> diffuse;              ///< of a hybrid picture
  WithLayers layers = WithLayers::no;              ///< of light, of a hybrid picture or a reference
  std::vector<Feature> features;                   ///< layers of the scene, not of a reference
  std::optional<DebugView> view;                   ///< painted instead of light
  PixelFilter filter = PixelFilter::box;           ///< not of a reference
  std::optional<double> pixel_error;               ///< of a hybrid picture: adaptive sampling
  std::optional<int> glossy_samples;               ///< of a hybrid picture: directions into a lobe
  std::optional<double> max_error;                 ///< of a reference
  std::optional<double> max_seconds;               ///< of a reference
  std::optional<Rgb> background;                   ///< radiance beyond the scene
  std::optional<std::uint64_t>
      memory_limit; ///< bytes of the whole run; all the machine has otherwise
  int threads = 0;  ///< 0: all the machine has
  std::uint32_t seed = 0;
};

/// Whether the field knows the light that does not come from emitters by itself:
/// means of elements by the analytic method do not.
bool tells_light_apart(const RunSettings& settings);

/// What is asked for, or what the preset has;
/// `interpolated` where the mode or the field knows no other.
DiffuseTerm diffuse_term(const RunSettings& settings);

/// Numbers of rays and samples are rounded up to powers of two.
TwoPassSettings two_pass_settings(const RunSettings& settings);

/// The limits that are given, or else the preset's error. Samples are rounded up to whole batches.
reference::ReferenceSettings reference_settings(const RunSettings& settings);

/// What was rounded, a sentence each.
std::vector<std::string> rounding_notes(const RunSettings& settings);

} // namespace meninas
