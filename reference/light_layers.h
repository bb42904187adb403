// The picture as a sum of nine layers,
// by the rule of the two passes' layers (raytrace/render.h) but read off the paths themselves:
//
//   eye, specular paths, x1, mirrors, x2, ..., light
//
// x1 is the first surface that emits or scatters evenly, seen straight,
// by one reflection (`.mirror`) or by several (`.mirrors`):
// of ideal mirrors, and of the lobes of glossy metals, coats and glass, however wide
// (light in a direction of its own is on a specular path). The emission of x1 is `emission`;
// its reflected light is `diffuse.mirrored` if mirrors are between x1 and x2 (the light itself,
// when there is nothing between), else `diffuse.direct`. There mirrors are ideal metals,
// all glass, and the gloss and coats that pass one takes for mirrors (Material::specular_in_pass_one);
// other gloss and coats are x2, as pass one spreads what they reflect.
// Glass that a path passes, straight, bent or blurred, does not count.
//
// One path may be of several layers:
// where a surface reflects f by parts f_even + f_gloss + f_glass,
// the path goes on for each of them in the share f_part / f of its light, by channel.
// So the layers add up to what the path brings, whichever lobe its direction was drawn from.
#pragma once

#include "scenes/materials/lobes.h"

#include <array>
#include <cstddef>
#include <cstdint>
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

/// The layers that a path may belong to, as far as it is known from the eye on, each with its
/// share of the path's light.
class LightRoutes {
public:
  /// Off that many mirrors.
  [[nodiscard]] LightRoutes reflected(std::size_t mirrors) const;
  /// Back from a surface, by the shares of its lobes; evenly in what these leave.
  [[nodiscard]] LightRoutes scattered(const LobeShares& shares) const;
  /// Light that is emitted where the path ends.
  void add(const Rgb& radiance, LayerRadiance& layers) const;

private:
  /// Before x1, and behind it: towards x2, straight or by mirrors so far, or past it.
  enum Leg : std::size_t { seeing, straight, mirrored, straight_done };
  static constexpr std::size_t leg_count = 4, way_count = 3; ///< ways of seeing x1
  /// By leg, then by way; `some` has a bit for each that is there.
  std::array<Rgb, leg_count * way_count> share_{Rgb(1.0)};
  std::uint32_t some_ = 1;

  void take(std::size_t leg, std::size_t way, const Rgb& share);
  void take_mirrored(std::size_t leg, std::size_t way, std::size_t mirrors, const Rgb& share);
};

/// Mean luminances of the layers of a picture.
using LayerLuminances = std::array<double, layer_count>;

/// The luminance of some layers over that of others,
/// from independent batches of one picture (at least two):
///   s = sum p_b / sum w_b,   variance = sum (p_b - s w_b)^2 / (m (m - 1)) / (sum w_b / m)^2,
/// the linearised variance of a ratio of means (Cochran, Sampling Techniques, section 6.4).
/// 0 where there is no light.
struct Share {
  double value = 0.0;
  double standard_error = 0.0;
};
using LayerChoice = std::function<bool(std::string_view name)>;
Share share_of(const std::vector<LayerLuminances>& batches, const LayerChoice& part,
               const LayerChoice& whole);

} // namespace meninas::reference
