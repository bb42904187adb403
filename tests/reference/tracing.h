// Small references of test scenes, and expectations that know their noise.
#pragma once

#include "reference/reference_picture.h"
#include "tests/support/scene_builder.h"

namespace meninas::test {

/// Exactly that many samples.
reference::ReferenceSettings tracing(int width, int height, int samples);

reference::ReferencePicture traced_picture(const Scene& scene, const Camera& camera,
                                           const reference::ReferenceSettings& settings);

/// The mean over all pixels and its standard error.
struct MeanRadiance {
  Rgb mean{0.0};
  Rgb error{0.0};
};
MeanRadiance mean_radiance(const reference::ReferencePicture& picture);

/// A pixel's worth of what a narrow view sees: the radiance at `target` towards `eye`.
MeanRadiance radiance_seen(const Scene& scene, Point3 eye, Point3 target, int samples);

/// Within four standard errors, and these at most a hundredth of it:
/// a test that is too noisy to say anything fails.
void expect_radiance(const MeanRadiance& measured, const Rgb& exact, double max_error = 0.01);

} // namespace meninas::test
