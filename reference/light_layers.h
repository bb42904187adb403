// The picture as a sum of nine layers, by the rule of the two passes' layers (raytrace/render.h) but read off the paths themselves:
//
//   eye, ideal mirrors, x1, ideal mirrors, x2, ..., light
//
// x1 is the first surface that scatters or emits, seen straight, in one mirror (`.mirror`) or by way of several (`.mirrors`). What it emits
// is `emission`; what it reflects is `diffuse.mirrored` if mirrors are between x1 and x2 (the light itself, when there is nothing between), else
// `diffuse.direct`. At x1 all lobes that scatter count alike: also what a rough metal or a rough coat reflects is `diffuse`. An ideal lobe
// (metal, smooth coat, pane) is a mirror; what is passed straight is no part of the way.
#pragma once

#include "scenes/types.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace meninas::reference {

inline constexpr std::size_t layer_count = 9;

/// `emission`, `diffuse.direct`, `diffuse.mirrored`, each with ``, `.mirror`, `.mirrors`.
std::string layer_name(std::size_t layer);

/// By layer.
using LayerRadiance = std::array<Rgb, layer_count>;
Rgb sum_of(const LayerRadiance& layers);

/// What of a path, from the eye on, decides about its layer.
struct LightRoute {
  std::size_t scatterings = 0;
  std::size_t mirrors_seen = 0;     ///< before x1
  std::size_t last_leg_mirrors = 0; ///< between x1 and x2
};
LightRoute scattered(LightRoute route);
LightRoute reflected(LightRoute route, std::size_t mirrors);

/// Of light that is emitted where the route ends.
std::size_t layer_of(const LightRoute& route);

/// Mean luminances of the layers of a picture.
using LayerLuminances = std::array<double, layer_count>;

/// The luminance of some layers over that of others, from independent batches of one picture (at least two):
///   s = sum p_b / sum w_b,   variance = sum (p_b - s w_b)^2 / (m (m - 1)) / (sum w_b / m)^2,
/// the linearised variance of a ratio of means (Cochran, Sampling Techniques, section 6.4). 0 where there is no light.
struct Share {
  double value = 0.0;
  double standard_error = 0.0;
};
using LayerChoice = std::function<bool(std::string_view name)>;
Share share_of(const std::vector<LayerLuminances>& batches, const LayerChoice& part,
               const LayerChoice& whole);

} // namespace meninas::reference
