#include "raytrace/quad_lanes.h"
#include "tests/raytrace/pictures.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double reflectance = 0.5;

/// Two triangles that make a quad with a nearly vanishing side, and nothing else.
Scene sliver_quad() {
  Scene scene;
  add_polygon(scene, "sliver", {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0.02, 0.045, 0}},
              double_sided(diffuse(reflectance)));
  scene.background = Rgb(1.0);
  scene.cameras.push_back(look_at({0.7, 0.4, 2.5}, {0.7, 0.4, 0}, 0.6));
  return scene;
}

/// A plate as exporters triangulate it: a fan about a corner of the rim.
Scene plate() {
  constexpr int corners = 64;
  std::vector<Point3> rim;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    rim.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  Scene scene;
  add_polygon(scene, "plate", rim, double_sided(diffuse(reflectance)));
  scene.background = Rgb(1.0);
  scene.cameras.push_back(look_at({0, 0, 4}, {0, 0, 0}, 0.6));
  return scene;
}

std::size_t general_faces(const LightScene& light) {
  return static_cast<std::size_t>(
      std::ranges::count_if(light.landing.faces, [](const FaceRecord& face) {
        return face.side != FaceRecord::nothing && face.map == UvMap::general;
      }));
}

// Under an even sky of radiance 1 a flat thing on which nothing stands has the irradiance pi, and
// shows its reflectance. Pixels on its rim are between that and the sky.
TEST(QuadLanes, SliversAreSeenBeforeNothing) {
  for (const Scene& scene : {sliver_quad(), plate()}) {
    PassOneSettings settings;
    settings.mesh.target_elements = 200;
    const Taken taken = lit_up(scene, settings);
    ASSERT_GT(general_faces(*taken.prepared->light()), 0U);
    RenderSettings render;
    render.width = render.height = 48;
    render.samples = 4;
    render.diffuse.term = DiffuseTerm::interpolated;
    const Image image = picture(taken, scene.cameras[0], render);
    std::size_t covered = 0, beside = 0;
    for (const glm::vec3& pixel : image.pixels) {
      // All rays escape, so that no noise is added to the rounding of floats.
      EXPECT_GT(pixel.g, reflectance - 1e-5);
      EXPECT_LT(pixel.g, 1.0 + 1e-5);
      covered += pixel.g < reflectance + 1e-5 ? 1 : 0;
      beside += pixel.g > 1.0 - 1e-5 ? 1 : 0;
    }
    EXPECT_GT(covered, 200U);
    EXPECT_GT(beside, 200U);
  }
}

TEST(QuadLanes, LanesThatHitNothingAreLeftAlone) {
  const Taken taken = lit_up(sliver_quad(), {});
  const LightScene& light = *taken.prepared->light();
  ASSERT_GT(general_faces(light), 0U);
  const FaceRecord& face = light.landing.faces[0];
  HitPacket hits;
  std::uint32_t landed = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const bool hit = k % 3 == 1;
    landed |= hit ? 1U << k : 0U;
    hits.triangle[k] = hit ? 0 : index(none<TriangleId>);
    hits.b1[k] = hit ? 0.05F * float(k) : std::numeric_limits<float>::quiet_NaN();
    hits.b2[k] = hit ? 0.01F * float(k) : std::numeric_limits<float>::infinity();
    hits.front[k] = 1;
  }
  const LanePoints at = land_on_quad(light, light.landing.elements, face, hits, landed);
  for_each_lane(landed, [&](std::uint32_t k) {
    const Landing alone = land(light.landing.elements, face.side, uv_of(light, face, hits, k));
    EXPECT_EQ(at.element[k], alone.element);
    EXPECT_EQ(at.s[k], alone.st.x);
    EXPECT_EQ(at.t[k], alone.st.y);
  });
}

// What is no number must not become an index: that would be out of every table.
TEST(QuadLanes, PlacesAreInTheSideWhateverTheirNumbers) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                  infinity = std::numeric_limits<float>::infinity();
  for (const bool triangle : {false, true}) {
    const SideRecord side{100, 7, triangle ? 7 : 5, triangle, false};
    const std::uint32_t end = 100 + (triangle ? 49 : 35);
    for (const float u : {nan, -infinity, -1.0F, 0.0F, 0.5F, 1.0F, 2.0F, infinity})
      for (const float v : {nan, -infinity, -1.0F, 0.0F, 0.5F, 1.0F, 2.0F, infinity}) {
        const std::uint32_t element = land_on_root(side, {u, v}).element;
        EXPECT_GE(element, 100U) << u << ' ' << v;
        EXPECT_LT(element, end) << u << ' ' << v;
      }
  }
}

} // namespace
} // namespace meninas::test
