// points_by_paths SCENE POINTS.csv [SAMPLES]: irradiance at points of matt surfaces by the path tracer,
//
//   H = pi L / rho,   W/m^2,
//
// L the radiance that a narrow view sees at the point, in 8 x 8 pixels of SAMPLES each (1024). Beside it
// its standard error: a second route to the numbers of `solve --points`, which shares no light with it.
// Points that lie on no surface that faces as they do and is matt are refused.
#include "reference/reference_picture.h"
#include "reference/scene_setup.h"
#include "runs/points/point_sets.h"
#include "scenes/errors.h"
#include "scenes/gltf/gltf.h"
#include "scenes/material.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace meninas {
namespace {

/// Of the surface a point lies on and that faces as it does.
double reflectance_at(const Scene& scene, const QueryPoint& at) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const auto [a, b, c] = corners(scene, TriangleId{t});
    const Vec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    const auto part = [&](const Point3& p, const Point3& q) {
      return glm::dot(glm::cross(p - at.position, q - at.position), normal) / (area * area);
    };
    const bool is_inside = part(a, b) > -1e-9 && part(b, c) > -1e-9 && part(c, a) > -1e-9;
    if (is_inside && glm::dot(normal, at.normal) > 0.99 * area &&
        std::abs(glm::dot(normal, at.position - a)) < 1e-6 * area)
      return diffuse_reflectance(scene.materials[index(scene.triangles[t].material)]).g;
  }
  return 0.0;
}

/// Throws InputError with the place of a point that no matt surface has.
void check_places(const Scene& scene, const std::vector<QueryPoint>& points,
                  const std::string& file) {
  for (const QueryPoint& at : points)
    if (!(reflectance_at(scene, at) > 0.0))
      throw InputError(file, fmt::format("{:g}, {:g}, {:g}", at.position.x, at.position.y, at.position.z),
                       "lies on no matt surface that faces as it does");
}

int samples_of(const std::string& text) {
  int samples = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), samples);
  if (problem != std::errc() || end != text.data() + text.size() || samples < 1)
    throw UsageError("SAMPLES", fmt::format("'{}' is not a whole number from 1", text));
  return samples;
}

Camera view_of(const QueryPoint& at) {
  Camera camera;
  const Direction aside = std::abs(at.normal.y) > 0.5 ? Direction(1, 0, 0) : Direction(0, 1, 0);
  camera.projection = Projection::orthographic;
  camera.position = at.position + 1e-3 * at.normal;
  camera.forward = -at.normal;
  camera.right = glm::normalize(glm::cross(camera.forward, aside));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.half_height = 1e-4;
  return camera;
}

void print_light(const reference::TracedScene& traced, const QueryPoint& at, int samples) {
  reference::ReferenceSettings settings;
  settings.width = settings.height = 8;
  settings.max_samples = samples;
  settings.max_error = 0.0;
  const auto picture = reference_picture(traced, view_of(at), settings);
  double mean = 0.0, variance = 0.0;
  for (std::size_t k = 0; k < picture.mean.pixels.size(); ++k) {
    mean += double(picture.mean.pixels[k].g) / 64.0;
    variance += double(picture.variance.pixels[k].g) / (64.0 * 64.0);
  }
  const double scale = std::numbers::pi / reflectance_at(traced.scene, at);
  std::printf("%g,%g,%g,%.6g,%.2g\n", at.position.x, at.position.y, at.position.z, scale * mean,
              scale * std::sqrt(variance));
}

} // namespace
} // namespace meninas

int main(int argc, char** argv) {
  using namespace meninas;
  if (argc < 3 || argc > 4) {
    std::fputs("usage: points_by_paths SCENE POINTS.csv [SAMPLES]\n", stderr);
    return 2;
  }
  try {
    const int samples = argc == 4 ? samples_of(argv[3]) : 1024;
    const auto traced = reference::make_traced_scene(load_gltf(argv[1]));
    const std::vector<QueryPoint> points = read_points(argv[2]);
    check_places(traced.scene, points, argv[2]);
    std::puts("x_m,y_m,z_m,irradiance_W_m2,standard_error_W_m2");
    for (const QueryPoint& point : points)
      print_light(traced, point, samples);
  } catch (const UserError& error) {
    std::fprintf(stderr, "points_by_paths: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
