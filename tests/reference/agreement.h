// The two passes against paths: two programs that share the materials and nothing else.
#pragma once

#include "raytrace/render_settings.h"
#include "scenes/scene.h"

#include <initializer_list>

namespace meninas::test {

struct Sight {
  const char* what;
  Point3 eye, target;
};

struct Agreement {
  DiffuseTerm term = DiffuseTerm::direct;
  int paths = 512;
  double noise = 0.03; ///< that these may have, relative
};

/// Radiances agree within four standard errors of the paths and a hundredth, the error of the field
/// on 10 cm elements.
void expect_agreement(const Scene& scene, std::initializer_list<Sight> sights, const Agreement& how = {});

} // namespace meninas::test
