#include "raytrace/error/picture_cost.h"

#include "raytrace/error/probes.h"
#include "raytrace/pixels/sample_choice.h"
#include "raytrace/views/view_light.h"

namespace meninas {

double expected_render_seconds(const std::shared_ptr<const LightScene>& light, const Camera& camera,
                               RenderSettings settings) {
  const double pixels = double(settings.width) * settings.height;
  double seconds = 0.0;
  if (settings.diffuse.term == DiffuseTerm::direct) {
    seconds = pixels * vertices_of_a_pixel * camera_ray_seconds(light, camera, settings);
    settings.diffuse.term = DiffuseTerm::interpolated; // between the vertices of the view's field
  }
  return seconds + pixels * first_samples(settings).count * camera_ray_seconds(light, camera, settings);
}

double expected_picture_bytes(double pixels, double planes, DiffuseTerm term) {
  // A plane of floats while it is rendered, once more while it is encoded, and the encoded file.
  constexpr double per_plane = 3.0 * sizeof(glm::vec3), per_picture = 4e6;
  constexpr double per_vertex = 350.0, per_point = 48.0;
  const double view_field =
      term == DiffuseTerm::direct ? vertices_of_a_pixel * per_vertex + per_point : 0.0;
  return per_picture + (per_plane * planes + view_field) * pixels;
}

} // namespace meninas
