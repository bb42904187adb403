// A lamp of many faces lights a room as all of its faces do, and small surfaces share samples.
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/scene/small_elements.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/globes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

/// A ball of 2 n^2 quads and triangles that glows, in a room.
Scene room_with_bulb(int n) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, {0, 0, 0}, {4, 2.6, 4}, walls);
  add_globe(scene, "bulb", {{2.0, 1.6, 2.0}, 0.15, 2 * n, n}, diffuse(0.5, 10.0));
  return scene;
}

struct ChoiceError {
  double largest = 0.0, rms = 0.0; ///< relative to all images
  std::size_t max_images = 0;     ///< at a point
};

/// Direct light at 64 points of the floor by default settings, against that of all images.
ChoiceError choice_error(const LitScene& l) {
  DirectWorkspace work;
  ChoiceError error;
  constexpr int points = 64;
  double squares = 0.0;
  for (int k = 0; k < points; ++k) {
    const Receiver floor{{0.3 + 0.4 * (k % 8), 0.01, 0.3 + 0.4 * (k / 8)}, {0, 1, 0}};
    const double few = direct_irradiance(*l.light, floor, {}, 17U + k, work).total.r;
    error.max_images = std::max(error.max_images, work.lights.size());
    const double all =
        direct_irradiance(*l.light, floor, {.images = 1 << 24}, 17U + k, work).total.r;
    error.largest = std::max(error.largest, std::abs(few / all - 1.0));
    squares += (few / all - 1.0) * (few / all - 1.0);
  }
  error.rms = std::sqrt(squares / points);
  return error;
}

// A lamp of many faces is seen from afar: without noise, and as all of its faces together.
TEST(LampFaces, AreSeenTogetherFromAfar) {
  const auto l = lit(room_with_bulb(24), {.element_size = 0.5});
  const ChoiceError error = choice_error(*l);
  // Nodes of a radius of a fifth of their distance: off by about a third of its square, 1.3 %.
  EXPECT_LT(error.largest, 0.015);
  // Of 1,152 faces no more than the shadow rays of one image: nothing is hidden in part.
  EXPECT_LE(error.max_images, std::size_t{16});
}

// Hundreds of lamps that stand apart are chosen from as ever: half a shadow of each is not one of all.
TEST(LampFaces, LampsThatStandApartAreNotOne) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, {0, 0, 0}, {4, 2.6, 4}, walls);
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) {
      const double x = 0.1 + 0.2 * i, z = 0.1 + 0.2 * k;
      add_polygon(scene, "lamp",
                  {{x, 2.5, z}, {x + 0.02, 2.5, z}, {x + 0.02, 2.5, z + 0.02}, {x, 2.5, z + 0.02}},
                  diffuse(0.0, 10.0 + i));
    }
  const auto l = lit(std::move(scene), {.element_size = 0.5});
  EXPECT_LT(choice_error(*l).rms, 0.01);
}

TEST(LampFaces, TakeFewSamples) {
  const auto l = lit(room_with_bulb(24), {.element_size = 0.5});
  const auto few = lit(room_with_bulb(3), {.element_size = 0.5});
  for (std::uint32_t e = 0; e < element_count(l->mesh); ++e)
    EXPECT_EQ(has_reduced_samples(*l->light, ElementId{e}), l->mesh.emission[e] != Rgb(0.0));
  for (std::uint32_t e = 0; e < element_count(few->mesh); ++e)
    EXPECT_FALSE(has_reduced_samples(*few->light, ElementId{e}));
  // Eight of them take what one other does.
  constexpr std::size_t faces = 2 * 24 * 24;
  EXPECT_EQ(sampled_elements(*l->light), element_count(l->mesh) - faces + faces / 8);
  EXPECT_EQ(sampled_elements(*few->light), element_count(few->mesh));
}

// What is finely tessellated has no more samples than its area has: small surfaces share theirs.
TEST(SmallElements, ShareSamplesWhereTheyAreMostOfAll) {
  for (const int rings : {24, 50}) {
    Scene scene = room_with_bulb(rings);
    for (Material& material : scene.materials)
      material.emission = Rgb(0.0);
    const auto l = lit(std::move(scene), {.element_size = 0.5});
    const double asked = 2.0 * (4.0 * 4.0 + 2.0 * 4.0 * 2.6) / 0.25;
    EXPECT_EQ(l->light->finely_tessellated, 2.0 * rings * rings > std::max(4.0 * asked, 4096.0));
    for (std::uint32_t e = 0; e < element_count(l->mesh); ++e)
      EXPECT_EQ(has_reduced_samples(*l->light, ElementId{e}),
                l->light->finely_tessellated && l->mesh.area[e] < 0.25 / 16.0);
  }
}

// They are kept for a scene under other light.
TEST(SmallElements, RowsDoNotDependOnWhatGlows) {
  for (const int rings : {24, 50}) {
    Scene dark = room_with_bulb(rings);
    for (Material& material : dark.materials)
      material.emission = Rgb(0.0);
    const auto on = lit(room_with_bulb(rings), {.element_size = 0.5}),
               off = lit(std::move(dark), {.element_size = 0.5});
    const FormFactorSettings settings{.rays = 128};
    const FormFactors lamp = assemble_transport(*on->light, settings),
                      bulb = assemble_transport(*off->light, settings);
    EXPECT_EQ(lamp.transport.columns, bulb.transport.columns) << rings;
    EXPECT_EQ(lamp.transport.weights, bulb.transport.weights) << rings;
  }
}

} // namespace
} // namespace meninas::test
