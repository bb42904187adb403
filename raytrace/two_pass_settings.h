// The settings of both passes, the numbers of pass two that a quality stands for, and the conversion of a
// user's choices to settings (radiosity/pass_one_settings.h).
#pragma once

#include "radiosity/pass_one_settings.h"
#include "raytrace/render_settings.h"

#include <optional>
#include <vector>

namespace meninas {

struct TwoPassSettings {
  PassOneSettings pass_one;
  RenderSettings render;
};

/// The numbers of pass two that a quality stands for.
struct RenderQuality {
  int samples = 0;          ///< camera rays per pixel, at most
  int min_samples = 0;      ///< that each pixel takes
  double pixel_error = 0.0; ///< beyond which it takes more (raytrace/pixels/sample_choice.h)
  DiffuseTerm diffuse = DiffuseTerm::interpolated; ///< of a hybrid picture
  int hit_shadow_rays = 0; ///< from a hit to an emitter, where light is computed there
  int pixel_penumbra_rays =
      0; ///< likewise, where the first ones disagree, shared out among a pixel's samples
  int vertex_penumbra_rays = 0; ///< likewise, from a vertex of the view's cells (ViewRefinement)
  double cell_tolerance = 0.0;  ///< of what these show (ViewRefinement)
  double finest_cell = 0.0;     ///< pixels (ViewRefinement)
};
RenderQuality render_quality(Quality quality);

/// A user's choices for both passes; values that are not set follow from the quality.
struct TwoPassChoice : PassOneChoice {
  std::optional<int> samples;            ///< rounded up to a power of two; of every pixel, without `pixel_error`
  std::optional<DiffuseTerm> diffuse;    ///< of a hybrid picture
  WithLayers layers = WithLayers::no;    ///< of light, of a hybrid picture or a reference
  std::vector<Feature> features;         ///< layers of the scene, not of a reference
  PixelFilter filter = PixelFilter::box; ///< not of a reference
  std::optional<double> pixel_error;     ///< of a hybrid picture: adaptive sampling
  std::optional<int> glossy_samples;     ///< of a hybrid picture: directions into a lobe
  std::optional<DisplayChoice> display;  ///< that will show the picture, not a reference
};

/// Whether the field knows the light that does not come from emitters by itself:
/// means of elements by the analytic method do not.
bool tells_light_apart(const PassOneChoice& choice);

/// The diffuse term that the user chose, or that of the quality;
/// `interpolated` where the mode or the field knows no other.
DiffuseTerm diffuse_term(const TwoPassChoice& choice, RenderMode mode);

/// Numbers of rays and samples are rounded up to powers of two.
TwoPassSettings two_pass_settings(const TwoPassChoice& choice, RenderMode mode);

} // namespace meninas
