// Light is found by choosing it, by meeting it, or by both with weights:
// all three have the same expectation.
#include "tests/reference/tracing.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

using reference::LightSearch;

MeanRadiance by(LightSearch search, const Scene& scene, const Camera& camera, int samples) {
  auto settings = tracing(12, 12, samples);
  settings.search = search;
  return mean_radiance(traced_picture(scene, camera, settings));
}

void expect_same(const MeanRadiance& a, const MeanRadiance& b) {
  for (int band = 0; band < 3; ++band) {
    const double error = std::hypot(a.error[band], b.error[band]);
    EXPECT_LT(error, 0.02 * a.mean[band]) << "too noisy to tell";
    EXPECT_NEAR(a.mean[band], b.mean[band], 4.0 * error) << band;
  }
}

/// Lamps of very different size, one of them double-sided, and a box to cast shadows.
Scene lamps_in_a_room() {
  Scene scene;
  add_room(scene, {0, 0, 0}, {3, 2.5, 4},
           {diffuse(0.7), diffuse({0.6, 0.2, 0.2}), diffuse(0.5), diffuse(0.7),
            diffuse({0.2, 0.5, 0.3}), diffuse(0.6)});
  add_box(scene, "box", {1.2, 0.0, 1.0}, {2.0, 0.9, 1.7}, diffuse(0.4));
  add_polygon(scene, "lamp", {{0.5, 2.4, 0.5}, {2.5, 2.4, 0.5}, {2.5, 2.4, 3.5}, {0.5, 2.4, 3.5}},
              diffuse(0.0, 4.0));
  add_polygon(scene, "sheet", {{0.2, 0.5, 2.0}, {0.8, 0.5, 2.0}, {0.8, 1.5, 2.0}, {0.2, 1.5, 2.0}},
              double_sided(diffuse(0.5, 6.0)));
  return scene;
}

TEST(LightSearch, ChoosingAndMeetingAndBothAgree) {
  const Scene scene = lamps_in_a_room();
  const Camera camera = look_at({2.3, 1.3, 3.6}, {1.0, 1.0, 0.5}, 1.1);
  const MeanRadiance both = by(LightSearch::both, scene, camera, 256);
  expect_same(both, by(LightSearch::choosing, scene, camera, 512));
  expect_same(both, by(LightSearch::meeting, scene, camera, 1024));
}

TEST(LightSearch, LightByWayOfMirrorsIsFoundInEveryWay) {
  const Scene scene = half_room();
  const Camera camera = look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0);
  const MeanRadiance both = by(LightSearch::both, scene, camera, 1024);
  expect_same(both, by(LightSearch::choosing, scene, camera, 1024));
  expect_same(both, by(LightSearch::meeting, scene, camera, 1024));
}

/// Two mirrors at a right angle,
/// so that chains of two and more matter, in a room with a large lamp.
TEST(LightSearch, ChainsOfMirrorsAreFoundInEveryWay) {
  Scene scene;
  add_room(scene, {0, 0, 0}, {3, 2.5, 4},
           {mirror(0.9), diffuse(0.6), diffuse(0.5), diffuse(0.7), mirror(0.8), diffuse(0.6)});
  add_polygon(scene, "lamp", {{0.5, 2.4, 0.5}, {2.5, 2.4, 0.5}, {2.5, 2.4, 3.5}, {0.5, 2.4, 3.5}},
              diffuse(0.0, 4.0));
  const Camera camera = look_at({2.3, 1.3, 3.6}, {1.0, 0.2, 0.5}, 0.6);
  const MeanRadiance both = by(LightSearch::both, scene, camera, 256);
  expect_same(both, by(LightSearch::choosing, scene, camera, 512));
  expect_same(both, by(LightSearch::meeting, scene, camera, 1024));
}

TEST(LightSearch, AMirrorRoomIsAsBrightAsTheDoubledRoom) {
  const Scene half = half_room();
  const Camera camera = look_at({1.6, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0);
  expect_same(by(LightSearch::both, half, camera, 1024),
              by(LightSearch::both, doubled(half), camera, 512));
}

} // namespace
} // namespace meninas::test
