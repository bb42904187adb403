#include "tests/reference/tracing.h"

#include "reference/scene_setup.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {

reference::ReferenceSettings tracing(int width, int height, int samples) {
  reference::ReferenceSettings settings;
  settings.width = width;
  settings.height = height;
  settings.max_samples = samples;
  settings.max_error = 0.0;
  return settings;
}

reference::ReferencePicture traced_picture(const Scene& scene, const Camera& camera,
                                           const reference::ReferenceSettings& settings) {
  return reference_picture(reference::make_traced_scene(scene), camera, settings);
}

MeanRadiance mean_radiance(const reference::ReferencePicture& picture) {
  MeanRadiance result;
  const double pixels = double(picture.mean.pixels.size());
  for (std::size_t k = 0; k < picture.mean.pixels.size(); ++k) {
    result.mean += Rgb(picture.mean.pixels[k]) / pixels;
    result.error += Rgb(picture.variance.pixels[k]) / (pixels * pixels);
  }
  result.error = glm::sqrt(result.error);
  return result;
}

MeanRadiance radiance_seen(const Scene& scene, Point3 eye, Point3 target, int samples) {
  // Eight by eight narrow pixels, so that samples of one batch are not all there is.
  return mean_radiance(traced_picture(scene, look_at(eye, target, 1e-4), tracing(8, 8, samples)));
}

void expect_radiance(const MeanRadiance& measured, const Rgb& exact, double max_error) {
  for (int band = 0; band < 3; ++band) {
    EXPECT_LE(measured.error[band], max_error * exact[band]) << band;
    // What is known without noise is known to the rounding of floats in rays and pixels.
    const double allowed = 4.0 * measured.error[band] + 1e-5 * exact[band];
    EXPECT_NEAR(measured.mean[band], exact[band], allowed) << band;
  }
}

} // namespace meninas::test
