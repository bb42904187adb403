#include "tests/raytrace/glass_pictures.h"

#include "tests/support/rooms.h"

namespace meninas::test {

PassOneSettings coarse(double element_size) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = 256;
  settings.solver.tolerance = 1e-6;
  return settings;
}

RenderSettings one_pixel() {
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.diffuse.term = DiffuseTerm::direct;
  return settings;
}

glm::dvec3 seen(const Scene& scene, Point3 eye, Point3 target, const RenderSettings& settings,
                double element_size) {
  return picture(lit_up(scene, coarse(element_size)), look_at(eye, target, 1e-4), settings)
      .pixels[0];
}

} // namespace meninas::test
