// Settings and result of a rendering (render.h): radiance L = L_e + rho H / pi at the surface each pixel sees,
// W/m^2/sr, as the mean over its samples.
#pragma once

#include "image/display.h"
#include "image/image.h"
#include "raytrace/diffuse_term.h"
#include "raytrace/pixels/pixel_filter.h"

#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace meninas {

enum class RenderMode {
  radiosity, ///< pass one alone, Gouraud-shaded: mirrors are black
  hybrid     ///< mirrors followed
};

/// The content of layers other than light (features.h).
enum class Feature { depth, normal, albedo, element, irradiance, alpha };
inline constexpr std::array all_features{Feature::depth, Feature::normal, Feature::albedo,
                                         Feature::element, Feature::irradiance, Feature::alpha};
/// "depth"
std::string_view name_of(Feature feature);

/// The display for which the picture is made.
struct DisplayChoice {
  std::optional<double> exposure; ///< stops; the automatic one otherwise
  ViewTransform transform = ViewTransform::srgb;
};

/// Pixels of a picture: from (x, y) on.
struct PictureWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PictureWindow&) const = default;
};

struct RenderSettings {
  RenderMode mode = RenderMode::hybrid;
  int width = 512;
  int height = 512;
  int samples = 16;                     ///< per pixel, a power of two
  double min_throughput = 1.0 / 1024.0; ///< of a specular path, below which it ends
  int max_bounces = 1000;
  int glossy_samples =
      16; ///< directions of a camera ray into the widest and brightest lobes (glossy_frustum.h)
  std::uint32_t seed = 0;
  PixelFilter filter = PixelFilter::box;
  /// Above 0: no more samples than it takes for pixels to be right
  /// to this share of themselves or of the mean (sample_choice.h).
  double pixel_error = 0.0;
  int min_samples = 4; ///< that each pixel takes then
  WithLayers layers = WithLayers::no; ///< as `render_layers` makes them
  std::vector<Feature> features;      ///< layers after those
  DiffuseSettings diffuse;
  /// Edges of what is brighter than a display that shows the picture so (pixels/bright_edges.h).
  std::optional<DisplayChoice> display;
  /// Pixels that are wanted, those of a part (pixels/picture_window.h); none: all. Others are not what they would be.
  std::optional<PictureWindow> window;
};

/// By pixel, row by row; empty: all have as many as the settings say.
using SampleCounts = std::vector<std::uint32_t>;

struct Rendering {
  Image image; ///< radiance
  SampleCounts samples;
  ShownPixels edges; ///< as RenderSettings::display asks for
  std::vector<ShownPixels> likely_edges; ///< of a window: for each exposure that the whole picture may turn out to have
  std::vector<Layer>
      layers; ///< of render_layers: they add up to the image, in their order; then features
  std::shared_ptr<const IrradianceField> finer; ///< that the picture shows (views/view_light.h); null: the one that was asked for
  std::uint64_t camera_rays = 0;
  std::uint64_t specular_rays = 0;
  std::uint64_t sure_rays = 0;   ///< of these two, not traced (coherent_beams.h)
  std::uint64_t shadow_rays = 0; ///< of diffuse terms computed at the hit
  std::uint64_t gather_rays = 0;
};

} // namespace meninas
