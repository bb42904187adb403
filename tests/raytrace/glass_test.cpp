// Panes and polished coats in both passes:
// what they pass and reflect, by closed forms and by what may not change.
#include "tests/raytrace/glass_pictures.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

/// What clear panes of ior 1.5 pass and reflect.
double passed(double cosine) { return pane_transmittance(1.5, cosine); }
double reflected(double cosine) { return 1.0 - passed(cosine); }

PunctualLight bulb(Point3 at) {
  PunctualLight light;
  light.position = at;
  return light;
}

void add_floor(Scene& scene, double half, const Material& material) {
  add_polygon(scene, "floor",
              {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}}, material);
}

void add_pane(Scene& scene, double height, const Material& material) {
  add_polygon(scene, "pane", {{-9, height, 9}, {9, height, 9}, {9, height, -9}, {-9, height, -9}},
              material);
}

TEST(GlassPasses, ABulbThroughAPaneByFresnelAndTint) {
  // So dark a floor that what the pane sends back to it does not matter.
  constexpr double rho = 1e-5;
  Scene scene;
  add_floor(scene, 3.0, diffuse(rho));
  const Rgb tint(0.5, 0.9, 1.0);
  add_pane(scene, 1.0, glass(tint));
  for (const Point3 at : {Point3(0, 2, 0), Point3(3, 2, 0), Point3(6, 2, -3)}) {
    scene.lights = {bulb(at)};
    const double cosine = glm::normalize(at).y;
    const double f = face_reflectance(1.5, cosine);
    const Rgb through = (1.0 - f) * (1.0 - f) * tint / (1.0 - f * f * tint * tint);
    const Rgb exact = rho / pi * cosine / glm::dot(at, at) * through;
    const glm::dvec3 found = seen(scene, {0, 0.5, 0.4}, Point3(0.0));
    EXPECT_LT(glm::distance(found, exact), 1e-3 * glm::length(exact)) << cosine;
  }
}

TEST(GlassPasses, ALampThroughAPaneAsWithoutItTimesWhatPasses) {
  // The lamp is small: the cosine at the pane is that of its centre.
  constexpr double rho = 1e-5;
  Scene scene;
  add_floor(scene, 3.0, diffuse(rho));
  add_polygon(scene, "lamp", {{1.9, 2, -0.1}, {2.1, 2, -0.1}, {2.1, 2, 0.1}, {1.9, 2, 0.1}},
              diffuse(0.0, 10.0));
  const Point3 eye{0, 0.5, 0.4};
  const double bare = seen(scene, eye, Point3(0.0)).g;
  add_pane(scene, 1.0, glass(Rgb(1.0)));
  EXPECT_NEAR(seen(scene, eye, Point3(0.0)).g / bare, passed(std::sqrt(0.5)), 2e-3);
}

TEST(GlassPasses, APaneThrowsALampOnTheWall) {
  // The lamp shines down alone, and the wall stands above it:
  // only the pane below throws light up. Of its image at y = -1,
  // 4 m2 of radiance 1, every point of which is about as far and as oblique.
  constexpr double rho = 1e-5;
  Scene scene;
  add_pane(scene, 0.0, glass(Rgb(1.0)));
  add_polygon(scene, "lamp", {{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}}, diffuse(0.0, pi));
  add_polygon(scene, "wall", {{-1, 3, -4}, {1, 3, -4}, {1, 5, -4}, {-1, 5, -4}}, diffuse(rho));
  const Point3 at(0, 4, -4);
  double irradiance = 0.0;
  constexpr int cells = 200;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 way =
          Point3(2.0 * (i + 0.5) / cells - 1.0, -1.0, 2.0 * (j + 0.5) / cells - 1.0) - at;
      const double r = glm::length(way), up = -way.y / r;
      irradiance += reflected(up) * up * (way.z / r) / (r * r) * 4.0 / (cells * cells);
    }
  // The pane has a mirror world: 16 points on the lamp's image say how much of it is reflected.
  EXPECT_NEAR(seen(scene, {0, 4, -3}, at).g, rho / pi * irradiance, 0.01 * rho / pi * irradiance);
}

TEST(GlassPasses, TheEyeSeesThroughAndByReflection) {
  Scene scene;
  // A red wall that glows behind the pane, a blue one on the eye's side.
  add_polygon(scene, "behind", {{-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}},
              diffuse(Rgb(0.0), Rgb(pi, 0.0, 0.0)));
  add_polygon(scene, "before", {{9, -9, 4}, {-9, -9, 4}, {-9, 9, 4}, {9, 9, 4}},
              diffuse(Rgb(0.0), Rgb(0.0, 0.0, pi)));
  add_polygon(scene, "pane", {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}},
              glass({0.5, 1.0, 1.0}));
  const glm::dvec3 found = seen(scene, {1, 0, 1}, Point3(0.0), one_pixel(), 2.0);
  const double cosine = std::sqrt(0.5);
  const double f = face_reflectance(1.5, cosine);
  EXPECT_NEAR(found.r, (1.0 - f) * (1.0 - f) * 0.5 / (1.0 - 0.25 * f * f), 1e-5);
  EXPECT_NEAR(found.b, reflected(cosine), 1e-5);
  // Without mirrors what is behind it is all there is, and the pane is never black.
  RenderSettings radiosity = one_pixel();
  radiosity.diffuse.term = DiffuseTerm::interpolated;
  radiosity.mode = RenderMode::radiosity;
  const glm::dvec3 straight = seen(scene, {1, 0, 1}, Point3(0.0), radiosity, 2.0);
  EXPECT_NEAR(straight.r, found.r, 1e-6);
  EXPECT_EQ(straight.b, 0.0);
}

/// Two rooms of glowing walls side by side,
/// joined by a window in which a pane stands that loses nothing.
TEST(GlassPasses, AFurnaceWithAPaneIsAFurnace) {
  Scene scene = furnace(0.5, {false, false, false, false, false, false});
  add_polygon(scene, "pane", {{0.1, 0.1, 0.5}, {0.9, 0.1, 0.5}, {0.9, 0.9, 0.5}, {0.1, 0.9, 0.5}},
              glass(Rgb(1.0)));
  const Taken taken = lit_up(scene, coarse());
  for (const Rgb& b : taken.solution.radiosity)
    EXPECT_NEAR(b.g, 2.0, 1e-3);
  EXPECT_LT(std::abs(taken.solution.energy.imbalance), 1e-3);
  EXPECT_LT(taken.solution.closure.max_error, 1e-6);
  RenderSettings settings = one_pixel();
  settings.diffuse.term = DiffuseTerm::interpolated;
  settings.width = settings.height = 8;
  const Image image = picture(taken, look_at({0.4, 0.5, 0.9}, {0.6, 0.4, 0.0}, 1.0), settings);
  for (const auto& pixel : image.pixels)
    EXPECT_NEAR(pixel.g, 2.0 / pi, 2e-3);
}

TEST(GlassPasses, EnergyIsAccountedFor) {
  const Taken taken = lit_up(glazed_room(), coarse());
  const EnergyBalance& energy = taken.solution.energy;
  // What is sampled from two ends agrees within the noise of 256 rays;
  // panes count by the mean over angles.
  EXPECT_LT(std::abs(energy.imbalance), 0.02);
  EXPECT_LT(taken.solution.closure.max_error, 1e-6);
  // The pane takes more red than green, and it alone.
  EXPECT_GT(energy.mirror_absorbed.r, 2.0 * energy.mirror_absorbed.g);
  EXPECT_GT(energy.mirror_absorbed.g, 0.0);
}

TEST(GlassPasses, ARoomWithAPaneTurned) {
  const Scene room = glazed_room();
  const double turn = 0.7;
  const glm::dmat3 rotation(std::cos(turn), 0, -std::sin(turn), 0, 1, 0, std::sin(turn), 0,
                            std::cos(turn));
  const Vec3 offset(3.0, -1.0, 2.0);
  const Scene turned = transformed(room, rotation, 1.0, offset);
  const Point3 eye{1.7, 1.2, 1.9}, target{0.8, 0.6, 0.5};
  RenderSettings settings = one_pixel();
  settings.diffuse.term = DiffuseTerm::interpolated;
  settings.width = settings.height = 24;
  const auto take = [&](const Scene& scene, Point3 from, Point3 to) {
    return picture(lit_up(scene, coarse()), look_at(from, to, 0.9), settings);
  };
  const Image plain = take(room, eye, target);
  const Image other = take(turned, rotation * eye + offset, rotation * target + offset);
  const PictureChange change = change_inside(plain, other, std::vector<bool>(24 * 24, false));
  // The same rays but for rounding, which decides on which side of an edge a few of them land.
  EXPECT_LT(change.rms, 0.01);
}

/// A camera inside the room, a pane of this glass in it or none.
Image room_with(const Material* pane) {
  Scene scene = glazed_room();
  scene.triangles.resize(scene.triangles.size() - 2);
  scene.materials.pop_back();
  if (pane)
    add_polygon(scene, "pane", {{0.2, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {0.2, 1.7, 0.8}},
                *pane);
  RenderSettings settings = one_pixel();
  settings.diffuse.term = DiffuseTerm::interpolated;
  settings.width = settings.height = 24;
  return picture(lit_up(scene, coarse()), look_at({1.7, 1.2, 1.9}, {0.8, 0.6, 0.5}, 0.9), settings);
}

TEST(GlassPasses, APaneOfAirChangesNothing) {
  const Material air = glass(Rgb(1.0), 1.0);
  const PictureChange change =
      change_inside(room_with(nullptr), room_with(&air), std::vector<bool>(24 * 24, false));
  // The same rays but for their rounding where they pass the pane,
  // which decides about elements at their edges.
  EXPECT_LT(change.rms, 2e-4);
  EXPECT_LT(change.worst, 5e-3);
}

TEST(GlassPasses, APaneIsNeverBlack) {
  // However few mirrors a path may meet, and however rough the glass is.
  for (const double roughness : {0.0, 0.5}) {
    Scene scene;
    add_polygon(scene, "behind", {{-9, -9, -2}, {9, -9, -2}, {9, 9, -2}, {-9, 9, -2}},
                diffuse(0.0, pi));
    Material pane = glass(Rgb(1.0));
    pane.roughness = roughness;
    for (int k = 0; k < 6; ++k)
      add_polygon(scene, "pane",
                  {{-9, -9, -0.1 * k}, {9, -9, -0.1 * k}, {9, 9, -0.1 * k}, {-9, 9, -0.1 * k}},
                  pane);
    RenderSettings settings = one_pixel();
    settings.max_bounces = 0;
    settings.diffuse.term = DiffuseTerm::interpolated;
    PassOneSettings pass_one = coarse(2.0);
    pass_one.form_factors.max_bounces = 0;
    const Image image =
        picture(lit_up(scene, pass_one), look_at({0, 0, 1}, Point3(0.0), 1e-4), settings);
    EXPECT_GT(image.pixels[0].g, 0.3) << roughness;
    if (roughness == 0.0) {
      EXPECT_NEAR(image.pixels[0].g, std::pow(passed(1.0), 6.0), 1e-5);
    }
  }
}

TEST(GlassPasses, AMirrorThatIsDiffuseAsWellKeepsItsEnergy) {
  // Half mirror, half white: the room absorbs by its walls alone.
  Scene scene = glazed_room();
  scene.triangles.resize(scene.triangles.size() - 2);
  scene.materials.pop_back();
  Material half = mirror(1.0);
  half.metallic = 0.5;
  scene.materials[0] = half;
  const EnergyBalance& energy = lit_up(scene, coarse()).solution.energy;
  EXPECT_LT(std::abs(energy.imbalance), 0.02);
  EXPECT_NEAR(energy.mirror_absorbed.g / energy.emitted.g, 0.0, 1e-3);
}

} // namespace
} // namespace meninas::test
