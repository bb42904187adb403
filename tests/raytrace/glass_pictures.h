// Pictures of small scenes with glass, one pixel wide.
#pragma once

#include "tests/raytrace/pictures.h"

namespace meninas::test {

PassOneSettings coarse(double element_size = 0.25);

/// With direct light at the hit: nothing of it is interpolated.
RenderSettings one_pixel();

/// What leaves `target` towards the eye.
glm::dvec3 seen(const Scene& scene, Point3 eye, Point3 target,
                const RenderSettings& settings = one_pixel(), double element_size = 0.25);

} // namespace meninas::test
