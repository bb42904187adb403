// Brushed metal in pass two: its lobe's grid, its highlights, and how they lie on the surface.
#include "raytrace/glossy_frustum.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/metals.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

Material brushed(double roughness, double strength, double reflectance = 1.0) {
  Material material = metal(Rgb(reflectance), roughness);
  material.anisotropy = strength;
  return material;
}

Bsdf bsdf_of(const Material& material) { return make_bsdf(material, untextured(material)); }

Direction at(double cosine, double azimuth) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// The furnace: what the grid and the field show of even light adds up to all of it.
TEST(AnisotropicLobes, WhiteReflectsAllOfEvenLightWhateverTheGrid) {
  std::vector<LobeRay> rays;
  for (const auto& [roughness, strength] :
       {std::pair(0.0, 0.5), std::pair(0.2, 0.3), std::pair(0.4, 1.0)})
    for (const double cosine : {1.0, 0.5, 0.02})
      for (const double azimuth : {0.0, 0.8, 1.57})
        for (const int n : {1, 3, 8}) {
          const Bsdf bsdf = bsdf_of(brushed(roughness, strength));
          const Direction out = at(cosine, azimuth);
          glossy_frustum(bsdf, out, n, {0.3, 0.9}, rays);
          Rgb all = even_reflectance(bsdf, out);
          for (const LobeRay& ray : rays)
            all += ray.weight;
          EXPECT_NEAR(all.g, 1.0, 1e-12) << roughness << ' ' << cosine << ' ' << azimuth;
        }
}

TEST(AnisotropicLobes, TheirGridConvergesToTheConvolution) {
  const auto light = [](const Direction& w) { return 1.0 + 0.7 * w.x + 0.5 * w.y * w.y; };
  for (const double azimuth : {0.2, 1.4}) {
    const Bsdf bsdf = bsdf_of(brushed(0.4, 0.7));
    const Direction out = at(0.7, azimuth);
    constexpr int rings = 512, spokes = 1024;
    double exact = 0.0;
    for (int r = 0; r < rings; ++r)
      for (int s = 0; s < spokes; ++s) {
        const double theta = 0.5 * pi * (r + 0.5) / rings;
        const Direction in = at(std::cos(theta), 2.0 * pi * (s + 0.5) / spokes);
        exact += reflection_lobe(bsdf, out, in).g * light(in) * in.z * std::sin(theta);
      }
    exact *= (0.5 * pi / rings) * (2.0 * pi / spokes);
    // Midpoints err by about 1 / n^2; the norm comes from a table good to 3e-3.
    for (const int n : {4, 16, 64}) {
      std::vector<LobeRay> rays;
      glossy_frustum(bsdf, out, n, {0.5, 0.5}, rays);
      double sum = 0.0;
      for (const LobeRay& ray : rays)
        sum += ray.weight.g * light(ray.in);
      EXPECT_NEAR(sum, exact, 4e-3 + 1.0 / (n * n)) << n << ' ' << azimuth;
    }
  }
}

TEST(AnisotropicLobes, TheDensityIsThatOfTheGridsDirections) {
  // The mean of 1 / p over directions with density p is the solid angle they fill: the hemisphere's
  // part that the lobe's support covers, all of it for wide facets and an upright look.
  const Bsdf bsdf = bsdf_of(brushed(0.7, 0.8));
  const Direction out = at(1.0, 0.0);
  std::vector<LobeRay> rays;
  double mean = 0.0;
  constexpr int n = 512;
  glossy_frustum(bsdf, out, n, {0.5, 0.5}, rays);
  for (const LobeRay& ray : rays)
    mean += 1.0 / lobe_density(bsdf, out, ray.in) / (n * n);
  EXPECT_NEAR(mean, 2.0 * pi, 0.02 * 2.0 * pi); // facets near the horizon fall between the cells
}

// --- In pictures

/// A plate in the plane y = 0 whose texture coordinates grow along x, and up the image is -z.
Scene plate(const Material& material) {
  Scene scene;
  add_polygon(scene, "plate", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, material);
  for (Vertex& v : scene.vertices)
    own_attributes(scene, v).texcoord[0] = {v.position.x, v.position.z};
  return scene;
}

constexpr Point3 eye{0.5, 1.0, 1.5}, bulb{-0.1, 1.2, -1.4};

Scene lit(Scene scene, Point3 position = bulb) {
  scene.lights = {
      {.name = "bulb", .kind = PunctualKind::point, .intensity = Rgb(3.0), .position = position}};
  return scene;
}

/// What leaves the origin towards the eye.
double seen(const Scene& scene, Point3 from = eye) {
  PassOneSettings coarse;
  coarse.mesh.element_size = 0.5;
  coarse.form_factors.rays = coarse.interpolation.rays = 64;
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.samples = 16;
  settings.diffuse.term = DiffuseTerm::direct;
  return picture(lit_up(scene, coarse), look_at(from, Point3(0.0), 1e-4), settings).pixels[0].g;
}

/// D V of the extension's text, with T along the direction, for unit vectors.
double khronos_lobe(double alpha, double strength, const Vec3& n, const Vec3& t, const Vec3& v,
                    const Vec3& l) {
  const Vec3 b = glm::cross(n, t), h = glm::normalize(v + l);
  const double wide = alpha + (1.0 - alpha) * strength * strength, ab = alpha, a2 = wide * ab;
  const Vec3 f(ab * glm::dot(t, h), wide * glm::dot(b, h), a2 * glm::dot(n, h));
  const double w2 = a2 / glm::dot(f, f), d = a2 * w2 * w2 / pi;
  const auto stretched = [&](const Vec3& w) {
    return glm::length(Vec3(wide * glm::dot(t, w), ab * glm::dot(b, w), glm::dot(n, w)));
  };
  return d * 0.5 / (glm::dot(n, l) * stretched(v) + glm::dot(n, v) * stretched(l));
}

// The light of a bulb, mirrored in the plate, and of bulbs beside it along and across the brush.
TEST(AnisotropicLobes, ABulbsHighlightIsThatOfTheExtensionsText) {
  constexpr double roughness = 0.35, strength = 0.6, rho = 0.8, turn = 0.7;
  const Vec3 n(0, 1, 0), t(std::cos(turn), 0.0, -std::sin(turn)); // counter-clockwise from above
  for (const Point3& position : {Point3(-0.5, 1.0, -1.5), Point3(0.2, 1.0, -1.2), bulb}) {
    Material material = brushed(roughness, strength, rho);
    material.anisotropy_direction = {std::cos(turn), std::sin(turn)};
    const Scene scene = lit(plate(material), position);
    const Vec3 v = glm::normalize(eye), l = glm::normalize(position);
    const double irradiance = 3.0 / glm::dot(position, position) * l.y;
    Bsdf bsdf = bsdf_of(material);
    const double exact = rho * khronos_lobe(roughness * roughness, strength, n, t, v, l);
    // What facets spread between them is even, by the azimuth that the eye is at.
    const double along = glm::dot(v, t);
    bsdf.axis = {1.0, 0.0};
    const Direction out(along, std::sqrt(1.0 - v.y * v.y - along * along), v.y);
    const double even = even_reflectance(bsdf, out).g / pi;
    EXPECT_NEAR(seen(scene), (exact + even) * irradiance, 2e-3 * (exact + even) * irradiance)
        << position.x;
  }
}

TEST(AnisotropicLobes, TurningTheMeshTurnsItsHighlight) {
  const Scene scene = plate(brushed(0.3, 0.7, 0.8));
  const double along = seen(lit(scene));
  // By a quarter turn about y: the square is the same, its texture coordinates turn with it.
  const glm::dmat3 quarter(Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(1, 0, 0));
  const double turned = seen(lit(transformed(scene, quarter, 1.0, Vec3(0.0))));
  Material across = brushed(0.3, 0.7, 0.8);
  across.anisotropy_direction = {0.0, 1.0};
  EXPECT_NEAR(turned, seen(lit(plate(across))), 1e-6 * turned);
  EXPECT_GT(std::abs(turned - along), 0.2 * along);
  // What is turned with its light and its eye is the same.
  const double all =
      seen(lit(transformed(scene, quarter, 1.0, Vec3(0.0)), quarter * bulb), quarter * eye);
  EXPECT_NEAR(all, along, 1e-5 * along);
}

} // namespace
} // namespace meninas::test
