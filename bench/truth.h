// Committed references (reference/images) and how far pictures are from them.
#pragma once

#include "image/image.h"

#include <filesystem>

namespace meninas::bench {

struct Truth {
  Image mean, variance;
};

/// Of the scene NAME.gltf: FOLDER/NAME.reference.exr.
Truth read_truth(const std::filesystem::path& folder, const std::filesystem::path& scene);

/// The error of a picture p against the reference r, relative:
///   e^2 = mean over pixels and channels of ((p - r)^2 - v) / (r + mean r)^2
/// with v the variance of r, so that the noise of the reference does not count.
double error_of(const Image& picture, const Truth& truth);

/// Of all threads, which other programs on the machine disturb less than time.
double processor_seconds();

} // namespace meninas::bench
