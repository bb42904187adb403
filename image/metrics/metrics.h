// Error metrics between a picture and its reference, in numbers and pixel by pixel.
//
// With a the picture, b the reference,
// means over all pixels and the three channels of linear radiance:
//   rmse     sqrt(mean((a - b)^2))
//   relmse   mean((a - b)^2 / (b^2 + epsilon)), epsilon = 0.01 (Rousselle, Knaus, Zwicker, "Adaptive rendering with non-local
//            means filtering", ACM TOG 31(6), 2012);
//            the one metric besides psnr that is not symmetric
//   mae      mean(|a - b|)
//   max_abs  max(|a - b|)
//   psnr     20 log10(peak / rmse) in dB, infinite for identical pictures; the peak is 1 for displayed pictures and the
//            largest value of the reference for radiance
// and on the pictures as displayed, multiplied by 2^exposure and clipped to [0, 1]:
//   ssim     image/metrics/ssim.h, 1 for identical pictures
//   flip     mean of image/metrics/flip.h, 0 for identical pictures
#pragma once

#include "image/channel.h"
#include "image/metrics/flip.h"
#include "image/image.h"

#include <array>
#include <optional>
#include <string>

namespace meninas {

enum class Metric { rmse, relmse, mae, psnr, max_abs, ssim, flip };
inline constexpr std::array all_metrics{Metric::rmse,    Metric::relmse, Metric::mae, Metric::psnr,
                                        Metric::max_abs, Metric::ssim,   Metric::flip};

/// "rmse", "relmse", ...
const char* name_of(Metric metric);

/// True for psnr and ssim, which are the larger the nearer two pictures are.
bool larger_is_nearer(Metric metric);

struct MetricSettings {
  double exposure = 0.0;           ///< stops, of the displayed pictures
  std::optional<double> peak = {}; ///< of psnr; the largest value of the reference otherwise
  double relmse_epsilon = 0.01;    ///< in units of radiance squared
  FlipSettings flip = {};
};

struct PictureDifference {
  int width = 0, height = 0;
  double rmse = 0.0, relmse = 0.0, mae = 0.0, psnr = 0.0, max_abs = 0.0, ssim = 1.0, flip = 0.0;
  glm::ivec2 worst{0}; ///< the first pixel (x, y) where max_abs is reached
  Channel ssim_map, flip_map;
};

double value_of(const PictureDifference& difference, Metric metric);

/// Both pictures have one size, at least one pixel and finite values.
PictureDifference compare_pictures(const Image& picture, const Image& reference,
                                   const MetricSettings& settings = {});

/// The contribution of each pixel: the root of the mean square over its channels (rmse, psnr),
/// the mean of its relative squares (relmse), of its absolute differences (mae),
/// their largest (max_abs), 1 - SSIM, FLIP. 0 where a pixel is right.
Channel error_map(const PictureDifference& difference, Metric metric, const Image& picture,
                  const Image& reference, const MetricSettings& settings = {});

/// The first pixel with a value that is not finite:
/// "pixel (x, y) is NaN", x from the left, y from the top.
std::optional<std::string> first_bad_pixel(const Image& picture);

} // namespace meninas
