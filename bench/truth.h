// Committed references (reference/images) and how far pictures are from them.
#pragma once

#include "image/image.h"
#include "scenes/scene.h"

#include <filesystem>
#include <optional>

namespace meninas::bench {

struct Truth {
  Image mean;
  std::optional<Image> variance; ///< of a path tracer's
  Scene scene;                   ///< of which it is, under its background
};

/// Of the scene NAME.gltf, which is read as well: FOLDER/NAME.reference.exr.
Truth read_truth(const std::filesystem::path& folder, const std::filesystem::path& scene);

/// The error of a picture p against the reference r, relative:
///   e^2 = mean over pixels and channels of ((p - r)^2 - v) / (r + mean r)^2
/// with v the variance of r, if it is known, so that the noise of the reference does not count.
double error_of(const Image& picture, const Truth& truth);

/// Of all threads, which other programs on the machine disturb less than time.
double processor_seconds();

} // namespace meninas::bench
