// Known answers of lighting design: what lamps of 100 lm make at a point one metre away, straight and by
// way of a mirror, and that points in the middle of a room have the light that surfaces would have there.
#include "radiosity/pass_one.h"
#include "radiosity/queries/point_light.h"
#include "scenes/ies/ies_file.h"
#include "scenes/photometry.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi, efficacy = 683.0;

/// Of what stands in an empty, black scene: no element reflects.
PointIrradiance light_at_point(const Scene& scene, const QueryPoint& point) {
  MeshSettings mesh;
  mesh.element_size = 0.5;
  const auto l = lit(scene, mesh);
  const std::vector<Rgb> black(element_count(l->mesh), Rgb(0.0));
  return irradiance_at_points(*l->light, black, std::array{point}, {.rays = 256}).front();
}

double lux(const Rgb& irradiance) { return luminous(efficacy, irradiance); }

/// Below the origin, which lamps at the origin shine on straight down.
const QueryPoint below{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};

/// Something to be a scene, black and out of the way.
Scene nothing() {
  Scene scene;
  add_polygon(scene, "away", {{4, -2, 1}, {5, -2, 1}, {5, -2, 0}, {4, -2, 0}}, diffuse(0.0));
  return scene;
}

/// A wall x = 1 that reflects all: the images of lamps at the origin stand at (2, 0, 0).
Scene beside_a_mirror() {
  Scene scene = nothing();
  add_polygon(scene, "mirror", {{1, -3, -3}, {1, -3, 3}, {1, 3, 3}, {1, 3, -3}}, mirror(1.0));
  return scene;
}

/// A square of 100 lm in all that faces down.
void add_small_lamp(Scene& scene) {
  constexpr double half = 1e-3, area = 4.0 * half * half;
  const double radiosity = 100.0 / efficacy / area; // W/m^2
  add_polygon(scene, "lamp", {{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}},
              diffuse(0.0, radiosity));
}

/// The frame of a luminaire that aims down: its -Z is -Y.
const glm::dmat3 downwards(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0));

PunctualLight luminaire(const std::string& ies) {
  return {.name = "luminaire",
          .intensity = Rgb(1.0 / efficacy),
          .distribution = std::make_shared<const IntensityDistribution>(parse_ies(ies)),
          .frame = downwards};
}

/// I = 100 / pi cos g, a candela value a degree.
std::string lambertian_ies() {
  std::string angles, candela;
  for (int g = 0; g <= 90; ++g) {
    angles += std::to_string(g) + '\n';
    candela += std::to_string(100.0 / pi * std::cos(g * pi / 180.0)) + '\n';
  }
  return "IESNA:LM-63-2002\nTILT=NONE\n1 100 1 91 1 1 2 0 0 0\n1 1 1\n" + angles + "0\n" + candela;
}

PunctualLight isotropic() {
  return {.name = "lamp", .intensity = Rgb(100.0 / (4.0 * pi) / efficacy)};
}

// E = 100 / pi at one metre: 31.83 lx. A lamp of 2 mm is off a point by its size squared, 1e-6.
TEST(Illuminance, OfASmallLambertianLamp) {
  Scene scene = nothing();
  add_small_lamp(scene);
  const PointIrradiance light = light_at_point(scene, below);
  EXPECT_NEAR(lux(light.total), 100.0 / pi, 1e-4);
  EXPECT_NEAR(lux(light.direct), 100.0 / pi, 1e-4);
  EXPECT_EQ(light.by_mirrors, Rgb(0.0));
}

// The same as a file: six digits behind the point.
TEST(Illuminance, OfTheSameLampAsAnIesFile) {
  Scene scene = nothing();
  scene.lights.push_back(luminaire(lambertian_ies()));
  EXPECT_NEAR(lux(light_at_point(scene, below).total), 100.0 / pi, 1e-5);
  // At 60 degrees, 2 m away: I cos / d^2 = 100 / pi * 0.5 * 0.5 / 4.
  const QueryPoint aside{{std::sqrt(3.0), -1.0, 0.0}, {0.0, 1.0, 0.0}};
  EXPECT_NEAR(lux(light_at_point(scene, aside).total), 100.0 / pi / 16.0, 1e-5);
  // Nothing upwards.
  EXPECT_EQ(lux(light_at_point(scene, {{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}).total), 0.0);
}

// E = 100 / 4 pi at one metre: 7.96 lx; rounding alone.
TEST(Illuminance, OfAnIsotropicPointLamp) {
  Scene scene = nothing();
  scene.lights.push_back(isotropic());
  EXPECT_NEAR(lux(light_at_point(scene, below).total), 25.0 / pi, 1e-9);
}

/// Cosine at lamp and point, and distance squared, of the image at (2, 0, 0): (-2, -1, 0) away.
constexpr double image_cosine2 = 1.0 / 5.0, image_distance2 = 5.0;

TEST(Illuminance, ByWayOfAMirrorIsTheSumOfBothImages) {
  Scene small = beside_a_mirror(), measured = beside_a_mirror(), point = beside_a_mirror();
  add_small_lamp(small);
  measured.lights.push_back(luminaire(lambertian_ies()));
  point.lights.push_back(isotropic());

  const double lambertian = 100.0 / pi, seen = lambertian * image_cosine2 / image_distance2;
  for (const Scene* scene : {&small, &measured}) {
    const PointIrradiance light = light_at_point(*scene, below);
    // As above; between its angles the file is linear: 1 degree squared / 8 of it, 4e-5.
    EXPECT_NEAR(lux(light.by_mirrors), seen, 4e-5 * seen + 1e-5);
    EXPECT_NEAR(lux(light.total), lambertian + seen, 2e-4);
    EXPECT_NEAR(lux(light.direct), lux(light.total), 1e-12) << "no diffuse surface has reflected it";
  }
  const PointIrradiance light = light_at_point(point, below);
  const double isotropic_seen = 25.0 / pi * std::sqrt(image_cosine2) / image_distance2;
  // Rays are followed in floats.
  EXPECT_NEAR(lux(light.by_mirrors), isotropic_seen, 1e-6);
  EXPECT_NEAR(lux(light.total), 25.0 / pi + isotropic_seen, 1e-6);
}

// A luminaire that shines to +x alone, and a little tilted: the mirror turns the direction round.
TEST(Illuminance, TheMirrorReflectsTheDistribution) {
  // Type C around its axis: 90 cd where it aims, falling to 0 at 90 degrees.
  const std::string beam = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n90 0\n";
  Scene scene = beside_a_mirror();
  scene.lights.push_back(luminaire(beam));
  // -Z is towards +x.
  scene.lights.front().frame = glm::dmat3(Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(-1, 0, 0));
  // Towards the image's point the ray leaves 26.565 degrees below +x.
  const double degrees = std::atan2(1.0, 2.0) * 180.0 / pi;
  const double expected = (90.0 - degrees) * std::sqrt(image_cosine2) / image_distance2;
  const PointIrradiance light = light_at_point(scene, below);
  EXPECT_NEAR(lux(light.by_mirrors), expected, 1e-6 * expected);
  EXPECT_NEAR(lux(light.total), expected, 1e-6 * expected) << "at 90 degrees it is dark";
}

// A lamp that brings a hundredth of the light, and that a board hides half of, is not decided by one ray.
TEST(PointLight, ADimLampInPartBesideABrightOne) {
  const double width[2] = {0.4, 0.2};
  double dim[2];
  for (const bool whole : {true, false}) {
    Scene scene = nothing();
    add_small_lamp(scene);
    const double x = 1.0 + width[whole ? 0 : 1];
    add_polygon(scene, "dim", {{1, 0, -0.2}, {x, 0, -0.2}, {x, 0, 0.2}, {1, 0, 0.2}}, diffuse(0.0, 0.03));
    if (whole) // from the point at (0, -1, 0) the line to x = 1.2 passes by (0.6, -0.5)
      add_polygon(scene, "board", {{0.6, -0.5, -1}, {3, -0.5, -1}, {3, -0.5, 1}, {0.6, -0.5, 1}},
                  double_sided(diffuse(0.0)));
    dim[whole ? 0 : 1] = lux(light_at_point(scene, below).total) - 100.0 / pi;
  }
  ASSERT_LT(dim[1], 0.02 * 100.0 / pi);
  // Some twenty rays of 2048 times its share: their net is off by one of them.
  EXPECT_NEAR(dim[0], dim[1], 0.1 * dim[1]);
}

// In a furnace B = E / (1 - rho) wherever one looks, so H = B at any point and for any plane in it.
TEST(PointLight, InTheMiddleOfAFurnace) {
  const double radiosity = 1.0 / (1.0 - 0.5);
  for (const bool mirrored : {false, true}) {
    MeshSettings mesh;
    mesh.element_size = 0.25;
    const auto l = lit(furnace(0.5, {mirrored, false, false, false, false, false}), mesh);
    const std::vector<Rgb> reflected(element_count(l->mesh), Rgb(radiosity - 1.0));
    const std::vector<QueryPoint> points{{{0.5, 0.5, 0.5}, {0.0, 1.0, 0.0}},
                                         {{0.2, 0.7, 0.4}, glm::normalize(Vec3(1.0, -2.0, 0.5))},
                                         {{0.3, 0.0, 0.3}, {0.0, 1.0, 0.0}},
                                         {{1.0, 0.25, 0.75}, {-1.0, 0.0, 0.0}}};
    for (const PointIrradiance& light : irradiance_at_points(*l->light, reflected, points, {.rays = 1024})) {
      // All that arrives is the same: rays and closed forms add up to it, shadow rays in floats aside.
      EXPECT_NEAR(light.total.g, radiosity, 1e-3);
      EXPECT_NEAR(light.direct.g, 1.0, 1e-3);
    }
  }
}

// The sky alone: pi L on a plane that faces it, half of that on one that stands upright.
TEST(PointLight, UnderAnEvenSky) {
  Scene scene = nothing();
  scene.background = Rgb(2.0);
  // The black square out of the way hides a thousandth of it.
  const PointIrradiance up = light_at_point(scene, {{0.0, 5.0, 0.0}, {0.0, 1.0, 0.0}});
  EXPECT_NEAR(up.total.g, 2.0 * pi, 1e-9);
  EXPECT_NEAR(up.direct.g, 2.0 * pi, 1e-9);
}

} // namespace
} // namespace meninas::test
