// Pass two: the picture. Camera rays meet the diffuse field or a mirror;
// mirrors are followed in chains until the path lands on the field,
// escapes, or its throughput falls below the visible threshold.
//
//   L(pixel) = mean over samples of  prod_k rho_s(k) (L_e + rho_d H / pi)   at the landing point
//
// Samples are stratified in the pixel, or where its filter is (pixel_filter.h),
// and seeded by hash(pixel, seed); tiles run in parallel and each writes its own pixels.
#pragma once

#include "image/image.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/pass_one.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/pixel_filter.h"

#include <array>
#include <string_view>

namespace meninas {

enum class RenderMode {
  radiosity, ///< pass one alone, Gouraud-shaded: mirrors are black
  hybrid     ///< mirrors followed
};

/// What layers beside those of light show (features.h).
enum class Feature { depth, normal, albedo, element, irradiance };
inline constexpr std::array all_features{Feature::depth, Feature::normal, Feature::albedo,
                                         Feature::element, Feature::irradiance};
/// "depth"
std::string_view name_of(Feature feature);

struct RenderSettings {
  RenderMode mode = RenderMode::hybrid;
  int width = 512;
  int height = 512;
  int samples = 16;                     ///< per pixel, a power of two
  double min_throughput = 1.0 / 1024.0; ///< of a specular path, below which it ends
  int max_bounces = 1000;
  int glossy_samples =
      16; ///< directions of a camera ray into the widest and brightest lobes (lobe_grid.h)
  std::uint32_t seed = 0;
  PixelFilter filter = PixelFilter::box;
  /// Above 0: no more samples than it takes for pixels to be right
  /// to this share of themselves or of the mean (sample_choice.h).
  double pixel_error = 0.0;
  WithLayers layers = WithLayers::no; ///< as `render_layers` makes them
  std::vector<Feature> features;      ///< layers after those
  DiffuseSettings diffuse;
};

/// By pixel, row by row; empty: all have as many as the settings say.
using SampleCounts = std::vector<std::uint32_t>;

struct Rendering {
  Image image; ///< radiance
  SampleCounts samples;
  std::vector<Layer>
      layers; ///< of render_layers: they add up to the image, in their order; then features
  std::uint64_t camera_rays = 0;
  std::uint64_t specular_rays = 0;
  std::uint64_t sure_rays = 0;   ///< of these two, not traced (sure_paths.h)
  std::uint64_t shadow_rays = 0; ///< of diffuse terms computed at the hit
  std::uint64_t gather_rays = 0;
};

Rendering render(const LightScene& light, const DiffuseField& field, const Camera& camera,
                 const RenderSettings& settings, const Progress& progress = {});

/// The same picture as the sum of nine layers, each traced for itself: `emission`, `diffuse.direct`
/// and `diffuse.mirrored` (light whose last leg to the surface was straight, or by way of mirrors),
/// seen straight, in one mirror (`.mirror`) and by way of several (`.mirrors`).
/// To the eye a mirror is also what reflects by a lobe, gloss, coats and glass;
/// to a surface ideal metals and glass alone, whose worlds pass one knows, while it spreads what
/// gloss and coats reflect. The four transport mechanisms: diffuse to diffuse is `diffuse.direct`,
/// specular to diffuse `diffuse.mirrored`, diffuse to specular what `.mirror` shows,
/// specular to specular what `.mirrors` shows. The field must know its mirrored part.
Rendering render_layers(const LightScene& light, const DiffuseField& field, const Camera& camera,
                        const RenderSettings& settings, const Progress& progress = {});

} // namespace meninas
