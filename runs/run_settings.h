// A user's choices for a run: a quality, and explicit values that override its numbers.
#pragma once

#include "raytrace/two_pass.h"
#include "raytrace/two_pass_settings.h"
#include "raytrace/views/debug_view.h"
#include "reference/reference_picture.h"
#include "runs/environment_choice.h"
#include "scenes/gltf/gltf.h"

#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// The numbers a quality stands for.
struct QualityPreset : PassOneQuality, RenderQuality {
  double max_error = 0.0; ///< of a reference: relative standard error of the picture
};
QualityPreset preset_of(Quality quality);

struct PictureSize {
  int width = 512;
  int height = 512;
};

/// One of so many windows of a picture (raytrace/pixels/picture_window.h), from 0.
struct PicturePart {
  int number = 0, count = 1;
};

/// The method by which a picture is made.
enum class PictureMode {
  radiosity, ///< pass one alone: mirrors are black
  hybrid,    ///< both passes
  reference  ///< path tracing, which shares nothing with them
};

struct RunSettings : TwoPassChoice {
  GltfSettings gltf; ///< how the scene's file is read
  PictureMode mode = PictureMode::hybrid;
  std::optional<Projection> projection; ///< in place of the camera's
  std::optional<PicturePart> part; ///< all that is wanted of the picture
  std::optional<DebugView> view;     ///< painted instead of light
  std::optional<double> view_top;    ///< the brightest colour of a view in lx or cd/m^2
  std::optional<double> max_error;   ///< of a reference
  std::optional<double> max_seconds; ///< of a reference
  std::optional<Rgb> background;     ///< radiance beyond the scene, from everywhere
  EnvironmentChoice environment;     ///< or by direction
  std::vector<LampFactor> lamp_factors; ///< how bright lamps are, beside what the file says
  bool lamp_layers = false;             ///< a layer for the light of each lamp, which add up to the picture
  std::optional<std::uint64_t>
      memory_limit; ///< bytes of the whole run; all the machine has otherwise
  int threads = 0;  ///< 0: all the machine has
};

/// As the two passes know them, which are not asked for a reference.
DiffuseTerm diffuse_term(const RunSettings& settings);
TwoPassSettings two_pass_settings(const RunSettings& settings);

/// With a diffuse term that is given, or else the preset's for this scene:
/// `interpolated` where its field does not know its light without that of emitters; `direct` where small surfaces
/// (radiosity/mesh/small_surfaces.h) give the mesh more vertices than a picture can show: finding direct light
/// where it is seen then takes about as long as at all vertices, and shadows end where they do.
RunSettings settled(RunSettings settings, const LightScene& light, bool knows_indirect = true);

/// Pass two of a picture, or a part of one, of that size.
/// Throws UsageError for more parts than such a picture has.
RenderSettings render_settings(const RunSettings& settings, PictureSize size);

/// The limits that are given, or else the preset's error. Samples are rounded up to whole batches.
reference::ReferenceSettings reference_settings(const RunSettings& settings);

/// The numbers that were rounded, a sentence each.
std::vector<std::string> rounding_notes(const RunSettings& settings);

} // namespace meninas
