#include "runs/walk/walk_cameras.h"

#include "image/display.h"
#include "raytrace/pixels/section_plane.h"
#include "raytrace/render.h"
#include "runs/preparation.h"

#include <algorithm>

namespace meninas {

namespace {

double exposure_from(const IrradianceField& field, const Camera& camera) {
  RenderSettings settings;
  settings.width = settings.height = 96;
  settings.samples = 4;
  settings.diffuse.term = DiffuseTerm::interpolated;
  return automatic_exposure(render(field, camera, settings).image);
}

/// For files without a camera: standing in the middle of the scene, along its longer side.
Camera inside(const Bounds& bounds) {
  const Vec3 size = bounds.high - bounds.low;
  constexpr double eye_height = 1.6, max_of_height = 0.6;
  Camera camera;
  camera.name = "inside";
  camera.position = 0.5 * bounds.low + 0.5 * bounds.high;
  camera.position.y = bounds.low.y + std::min(eye_height, max_of_height * size.y);
  camera.forward = size.x > size.z ? Direction(1.0, 0.0, 0.0) : Direction(0.0, 0.0, -1.0);
  camera.right = glm::cross(camera.forward, camera.up);
  return camera;
}

} // namespace

std::vector<WalkCamera> walk_cameras(const IrradianceField& field, const RunSettings& settings,
                                     const std::optional<double>& exposure) {
  const Scene& scene = field.scene->scene;
  std::vector<Camera> cameras = scene.cameras;
  if (cameras.empty())
    cameras = {default_view(bounds_of(scene), settings), inside(bounds_of(scene))};
  std::vector<WalkCamera> shown;
  for (const Camera& camera : cameras) {
    const double aspect = natural_aspect(camera) > 0.0 ? natural_aspect(camera) : 1.0;
    const Camera cutting = with_section(scene, camera, aspect);
    shown.push_back({cutting, exposure ? *exposure : exposure_from(field, cutting)});
  }
  return shown;
}

} // namespace meninas
