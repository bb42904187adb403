// Two picture files side by side: read, checked, measured, and held against limits.
#pragma once

#include "image/image_file.h"
#include "image/metrics/metrics.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// A picture out of a file: R, G, B, or those of one layer.
struct ComparedPicture {
  Image image;
  Encoding encoding = Encoding::linear; ///< of the file: sRGB code values are a displayed picture
  std::string unit;                     ///< of its values; empty where the file does not say
  std::vector<std::string> remarks;     ///< what of the file is compared, a line each
};

/// The unit of differences of the two: that of the reference, or of the picture if the reference does not state one.
/// Empty where neither says it.
std::string unit_of_differences(const ComparedPicture& picture, const ComparedPicture& reference);

/// Throws InputError for a file that cannot be read, has no such layer (naming the nearest),
/// or holds a value that is not finite (naming the pixel).
ComparedPicture read_compared(const std::filesystem::path& file,
                              const std::optional<std::string>& layer);

/// Throws InputError naming both files when their sizes differ.
void check_same_size(const Image& picture, const std::filesystem::path& picture_file,
                     const Image& reference, const std::filesystem::path& reference_file);

/// The display of the two and their peak:
/// code values as they are with peak 1, radiance at the automatic exposure of the reference.
MetricSettings metric_settings(const ComparedPicture& reference, std::optional<double> exposure);

struct MetricLimit {
  Metric metric = Metric::rmse;
  double limit = 0.0; ///< the largest value that passes; the smallest for psnr and ssim
};

/// " W/m^2/sr", as it stands behind a value of this metric of pictures in that unit; empty where it has none or it is
/// not known.
std::string unit_behind(Metric metric, const std::string& unit);

/// Whether the limit holds; a value that is NaN holds none.
bool holds(const PictureDifference& difference, const MetricLimit& limit);

/// "rmse 0.02 exceeds 0.01 W/m^2/sr", a line for each limit that is not held.
std::vector<std::string> broken_limits(const PictureDifference& difference,
                                       const std::vector<MetricLimit>& limits, const std::string& unit);

} // namespace meninas
