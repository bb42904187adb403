// Lenses and panoramas: paths against the two passes, which make their rays by themselves.
#include "raytrace/two_pass.h"
#include "tests/reference/tracing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A room of walls that glow, each in its own way, and reflect nothing, with a mirror and posts at
/// three distances: all that a picture can be wrong about is where its rays go.
Scene glowing_posts() {
  Scene scene;
  const auto glow = [](double r, double g, double b) { return diffuse(Rgb(0.0), Rgb(r, g, b)); };
  add_room(scene, {-2, -1, -6}, {2, 1, 1},
           {glow(1, 0, 0), glow(0, 1, 0), glow(0, 0, 1), glow(1, 1, 0), glow(0, 1, 1), glow(2, 1, 2)});
  const auto add_post = [&](double x, double z, const Material& material) {
    add_polygon(scene, "post",
                {{x - 0.1, -1, z}, {x + 0.1, -1, z}, {x + 0.1, 1, z}, {x - 0.1, 1, z}}, material);
  };
  add_post(-0.5, -1.5, glow(5, 5, 5));
  add_post(0.2, -3.0, glow(0, 5, 5));
  add_post(1.0, -5.0, glow(5, 0, 5));
  add_polygon(scene, "mirror", {{-1.9, -0.8, -1}, {-1.9, -0.8, -4}, {-1.9, 0.8, -4}, {-1.9, 0.8, -1}},
              mirror(0.8));
  return scene;
}

constexpr int rows = 24;

Image by_two_passes(const Scene& scene, const Camera& camera, int width) {
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 2.0;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 16;
  settings.render.width = width;
  settings.render.height = rows;
  settings.render.samples = 1024;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  return two_pass(*prepared, camera, settings).rendering.image;
}

struct Agreement {
  double rms = 0.0;  ///< relative to the mean
  double most = 0.0; ///< in standard errors of the paths, with what the other's samples are off by
};
Agreement agreement(const Image& image, const reference::ReferencePicture& truth) {
  Agreement found;
  double mean = 0.0;
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    for (int band = 0; band < 3; ++band) {
      const double off = double{image.pixels[k][band]} - truth.mean.pixels[k][band];
      // 1,024 stratified samples of an edge are off by less than 1 % of its step, of 1.6 here.
      const double error = std::sqrt(double{truth.variance.pixels[k][band]}) + 0.005;
      found.rms += off * off;
      mean += truth.mean.pixels[k][band];
      found.most = std::max(found.most, std::abs(off) / error);
    }
  const double values = 3.0 * double(image.pixels.size());
  found.rms = std::sqrt(found.rms / values) / (mean / values);
  return found;
}

TEST(Lens, OfPathsIsThatOfTheTwoPasses) {
  const Scene scene = glowing_posts();
  Camera camera = look_at({0.3, 0.1, 0.5}, {0.0, 0.0, -3.0}, 0.9);
  const Image pinhole = by_two_passes(scene, camera, 32);
  camera.lens_radius = 0.12;
  camera.focus_distance = 3.5;
  const auto paths = traced_picture(scene, camera, tracing(32, rows, 1024));
  const Agreement with_lens = agreement(by_two_passes(scene, camera, 32), paths);
  EXPECT_LT(with_lens.rms, 0.02);
  EXPECT_LT(with_lens.most, 6.0); // of 2,304 values
  EXPECT_GT(agreement(pinhole, paths).rms, 2.0 * 0.02) << "or else the bound tells of no lens";
}

TEST(Panoramas, OfPathsAreThoseOfTheTwoPasses) {
  const Scene scene = glowing_posts();
  for (const Projection projection : {Projection::equirectangular, Projection::cube}) {
    Camera camera = look_at({0.3, 0.1, -0.5}, {0.0, 0.0, -3.0}, 0.9);
    camera.projection = projection;
    const int width = (projection == Projection::cube ? 6 : 2) * rows;
    const auto paths = traced_picture(scene, camera, tracing(width, rows, 512));
    const Agreement found = agreement(by_two_passes(scene, camera, width), paths);
    EXPECT_LT(found.rms, 0.03);
    EXPECT_LT(found.most, 6.0);
  }
}

// Cloth with sheen: both passes show it by one formula; light that it throws is even in both.
TEST(Sheen, OfPathsIsThatOfTheTwoPasses) {
  Scene scene;
  Material cloth = diffuse(Rgb(0.3, 0.1, 0.1));
  cloth.sheen_color = Rgb(0.9, 0.8, 0.7);
  cloth.sheen_roughness = 0.5;
  const Material wall = diffuse(0.4, 1.0);
  add_room(scene, {-1, 0, -1}, {1, 2, 1}, {wall, wall, cloth, wall, wall, wall});
  TwoPassSettings settings;
  settings.pass_one.mesh.element_size = 0.1;
  settings.pass_one.form_factors.rays = settings.pass_one.interpolation.rays = 1024;
  settings.render.width = settings.render.height = 1;
  settings.render.samples = 64;
  const auto prepared = prepare_scene(scene, settings.pass_one);
  const RadiositySolution solution = solve_pass_one(prepared->light(), settings.pass_one);
  for (const Point3 eye : {Point3(0.0, 1.5, 0.0), Point3(0.9, 0.15, 0.0)}) {
    const Rgb seen = render(solution.field, look_at(eye, {0, 0, 0.01}, 1e-4), settings.render).image.pixels[0];
    const MeanRadiance truth = radiance_seen(scene, eye, {0, 0, 0.01}, 8192);
    // Light in the middle of the floor is not quite even: what is lobes by the direction of light
    // is shown as if it came from everywhere.
    for (int band = 0; band < 3; ++band)
      EXPECT_NEAR(seen[band], truth.mean[band],
                  4.0 * truth.error[band] + 0.03 * truth.mean[band]) << eye.x;
  }
}

} // namespace
} // namespace meninas::test
