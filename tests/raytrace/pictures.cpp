#include "tests/raytrace/pictures.h"

#include <glm/gtx/component_wise.hpp>

#include <algorithm>
#include <cmath>

namespace meninas::test {

Taken lit_up(const Scene& scene, const PassOneSettings& settings) {
  Taken taken{prepare_scene(scene, settings), {}};
  taken.solution = solve_pass_one(taken.prepared->light(), settings);
  return taken;
}

Image picture(const Taken& scene, const Camera& camera, const RenderSettings& settings) {
  return render(scene.solution.field, camera, settings).image;
}

PictureChange change_inside(const Image& before, const Image& after,
                            const std::vector<bool>& left_out) {
  PictureChange c;
  for (std::size_t k = 0; k < before.pixels.size(); ++k) {
    if (!left_out.empty() && left_out[k])
      continue;
    const glm::dvec3 a = before.pixels[k], b = after.pixels[k];
    const double size = std::max({a.r, a.g, a.b, 1e-12}),
                 error = glm::compMax(glm::abs(b - a)) / size;
    ++c.pixels;
    c.rms += error * error;
    c.worst = std::max(c.worst, error);
    if (error > 0.01)
      ++c.beyond_a_hundredth;
  }
  c.rms = std::sqrt(c.rms / double(std::max<std::size_t>(c.pixels, 1)));
  return c;
}

std::vector<bool> edges(const Scene& scene, const Camera& camera, const RenderSettings& settings) {
  // Every material but mirrors glows in a colour of its own and reflects nothing,
  // so that a picture is a map of surfaces.
  Scene map = scene;
  for (std::size_t m = 0; m < map.materials.size(); ++m) {
    Material& material = map.materials[m];
    if (is_mirror(material))
      continue;
    material.base_color = Rgb(0.0);
    material.emission = Rgb(1.0 + double(m), 1.0 + double(m * m % 17), 1.0);
  }
  PassOneSettings coarse;
  coarse.mesh.element_size = 1e9;
  coarse.form_factors.rays = coarse.interpolation.rays = 1;
  coarse.interpolation.method = Interpolation::average;
  const Image image = picture(lit_up(map, coarse), camera, settings);

  std::vector<bool> marked(image.pixels.size(), false);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = std::clamp(x + dx, 0, image.width - 1),
                    ny = std::clamp(y + dy, 0, image.height - 1);
          // Equal up to the rounding of sums of floats.
          if (glm::distance(image.at(x, y), image.at(nx, ny)) > 1e-3F)
            marked[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(x)] = true;
        }
  return marked;
}

} // namespace meninas::test
