// Light of narrow spots, and of lights close to a surface, arrives whatever the mesh is.
#include "radiosity/light/element_light.h"
#include "radiosity/light/spot_parts.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

using std::numbers::pi;

PunctualLight spot(const Point3& from, const Vec3& towards, double inner, double outer) {
  return {.name = "spot",
          .kind = PunctualKind::spot,
          .intensity = Rgb(5000.0),
          .position = from,
          .direction = glm::normalize(towards),
          .inner_cone = inner,
          .outer_cone = outer};
}

/// The integral over the cone of I t^2, t = clamp((cos - cos_o) / max(0.001, cos_i - cos_o), 0, 1).
double power_of(const PunctualLight& light) {
  const double outer = std::cos(light.outer_cone), inner = std::cos(light.inner_cone);
  const double width = std::max(1e-3, inner - outer);
  const double rim = std::min(width, 1.0 - outer); // up to where t is 1
  const double t = rim / width;
  return 2.0 * pi * light.intensity.r * (width * t * t * t / 3.0 + (1.0 - outer - rim));
}

Scene room_with(const PunctualLight& light) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.2));
  add_room(scene, {-1.5, 0, -1.5}, {1.5, 2.6, 1.5}, walls);
  scene.lights = {light};
  return scene;
}

/// What arrives at all elements, W.
double arrived(const LitScene& l) {
  double sum = 0.0;
  SharedLightWorkspace work;
  for (std::uint32_t e = 0; e < l.mesh.area.size(); ++e) {
    const MeanLight mean = direct_irradiance(*l.light, ElementId{e}, 0, {}, work);
    EXPECT_EQ(mean.entering, mean.total);
    sum += l.mesh.area[e] * mean.total.r;
  }
  return sum;
}

// 256 points in the cone itself: the integral of a smooth function, to a per cent. Walls that
// are met at a slant have most of it in a few of them.
TEST(SpotParts, ANarrowSpotArrivesOnAnyMesh) {
  for (const auto& light : {spot({0.137, 2.5, 0.0959}, {0, -1, 0}, 0.012, 0.022),
                            spot({0.137, 2.5, 0.0959}, {0.3, -1, 0.2}, 0.0, 0.002),
                            spot({0.0, 1.3, 0.0}, {1, 0.02, 1}, 0.1, 0.12),
                            spot({0.0, 1.3, 0.0}, {1, -0.5, 0.3}, 0.2, 0.7)})
    for (const double size : {3.0, 0.7, 0.3, 0.1}) {
      const double power = power_of(light);
      EXPECT_NEAR(arrived(*lit(room_with(light), {.element_size = size})), power, 0.02 * power)
          << light.outer_cone << " " << size;
    }
}

// Half of the light falls about the foot, I / h^2 there: points of elements miss it, or
// find it and take it for that of the whole element. Within 1 %: what two points make of
// the elements that are farther away.
TEST(SpotParts, LightOfALampCloseToTheCeilingArrives) {
  for (const double height : {0.1, 1e-2, 3e-3, 1e-3, 1e-5})
    for (const double size : {0.7, 0.2}) {
      PunctualLight light = spot({0.137, 2.6 - height, 0.0959}, {0, -1, 0}, 0.0, 0.0);
      light.kind = PunctualKind::point;
      const double power = 4.0 * pi * light.intensity.r;
      EXPECT_NEAR(arrived(*lit(room_with(light), {.element_size = size})), power, 0.01 * power)
          << height << " " << size;
    }
  // A wide spot beside a wall, along it. Within 2 %: the rim of its cone goes through elements all over the room.
  const PunctualLight grazing = spot({-1.499, 2.0, 0.0959}, {0, -1, 0}, 0.4, 0.9);
  const double power = power_of(grazing);
  EXPECT_NEAR(arrived(*lit(room_with(grazing), {.element_size = 0.3})), power, 0.02 * power);
}

// Triangles, and elements that a table's foot cuts: the spot falls beside it, its means are over
// what is left of the elements.
TEST(SpotParts, ArrivesOnTrianglesAndOnCutElements) {
  const PunctualLight light = spot({0.137, 2.5, 0.0959}, {0, -1, 0}, 0.05, 0.07);
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.2));
  add_room(scene, {-1.5, -3.0, -1.5}, {1.5, 2.6, 1.5}, walls);
  for (int k = 0; k < 4; ++k) { // a floor of four triangles about a point of the spot
    const std::array<Point3, 4> rim{
        Point3(-1.5, 0, -1.5), {-1.5, 0, 1.5}, {1.5, 0, 1.5}, {1.5, 0, -1.5}};
    add_polygon(scene, "floor", {{0.2, 0, 0.1}, rim[k], rim[(k + 1) % 4]}, diffuse(0.3));
  }
  scene.lights = {light};
  const double power = power_of(light);
  for (const double size : {2.0, 0.4}) {
    EXPECT_NEAR(arrived(*lit(scene, {.element_size = size})), power, 0.02 * power);
    // A wall stands through the spot, and shades nothing: seen from above it is a line.
    Scene walled = scene;
    add_polygon(walled, "sheet",
                {{0.137, 0, -1.0}, {0.137, 0, 1.0}, {0.137, 0.5, 1.0}, {0.137, 0.5, -1.0}},
                diffuse(0.3));
    EXPECT_NEAR(arrived(*lit(walled, {.element_size = size})), power, 0.02 * power) << size;
  }
}

// The image of a spot in a mirror is a spot.
TEST(SpotParts, ASpotOnAMirrorGoesOn) {
  for (const double size : {3.0, 0.2}) {
    Scene scene = room_with(spot({1.0, 1.5, 0.0}, {-2.4, -0.5, 0.0}, 0.01, 0.02));
    add_polygon(scene, "mirror",
                {{-1.4, 0.5, 1.0}, {-1.4, 0.5, -1.0}, {-1.4, 1.5, -1.0}, {-1.4, 1.5, 1.0}},
                mirror(0.8));
    const double power = power_of(scene.lights[0]);
    EXPECT_NEAR(arrived(*lit(scene, {.element_size = size})), 0.8 * power, 0.02 * power);
  }
}

// Elements are divided to a quarter of the spot, there alone.
TEST(SpotParts, ElementsAreDividedUnderANarrowSpot) {
  const PunctualLight light = spot({0.137, 2.5, 0.0959}, {0, -1, 0}, 0.012, 0.022);
  const auto l = lit(room_with(light), {.element_size = 0.3});
  const ElementMesh finer =
      divide_under_spots(l->mesh, l->scene, l->surfaces, l->plan.worlds, 1'000'000);
  EXPECT_LT(element_count(finer), element_count(l->mesh) + 500);
  const double width = 2.0 * 2.5 * std::tan(0.022);
  double finest = 1.0;
  for (std::uint32_t e = 0; e < element_count(finer); ++e)
    finest = std::min(finest, size_of(finer, ElementId{e}));
  EXPECT_LE(finest, width / 4.0);
  EXPECT_GT(finest, width / 16.0);
  const auto wide = lit(room_with(spot({0, 2.5, 0}, {0, -1, 0}, 0.5, 0.8)), {.element_size = 0.3});
  EXPECT_EQ(element_count(divide_under_spots(wide->mesh, wide->scene, wide->surfaces,
                                             wide->plan.worlds, 1'000'000)),
            element_count(wide->mesh));
}

} // namespace
} // namespace meninas::test
