// Mirrors that break careless code: slivers, sheets seen edge-on,
// lamps that touch or pierce a mirror, tiles, holes, and hundreds of tilts.
#include "radiosity/light/element_light.h"
#include "radiosity/transport/gathered_emission.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace meninas::test {
namespace {

const Material black = diffuse(0.0);

/// A black room 2 x 2 x 2 m, with a lamp above that looks down.
Scene black_room() {
  Scene scene;
  add_room(scene, Point3(0.0), Point3(2.0), {black, black, black, black, black, black});
  add_polygon(scene, "lamp", {{0.8, 1.9, 0.8}, {1.2, 1.9, 0.8}, {1.2, 1.9, 1.2}, {0.8, 1.9, 1.2}},
              diffuse(0.0, 10.0));
  return scene;
}

/// An upright rectangle in the plane x = const that faces +x.
std::vector<Point3> upright(double x, double y0, double z0, double y1, double z1) {
  return {{x, y0, z1}, {x, y0, z0}, {x, y1, z0}, {x, y1, z1}};
}

/// Direct irradiance by element of one node, by closed form through the mirror worlds.
std::vector<double> direct_on(const Scene& scene, const std::string& node,
                              const DirectSettings& settings = {}) {
  const auto l = lit(scene, {.element_size = 0.25});
  const DirectIrradiance direct = direct_irradiance(*l->light, {}, settings);
  std::vector<double> values;
  for (const std::size_t e : elements_of(*l, node))
    values.push_back(direct.irradiance[e].g);
  return values;
}

/// Rays alone against the closed form and what it leaves to rays, on the mean of every wall.
/// Some hundreds of thousands of rays leave a wall;
/// the error is that of the number of those that meet the lamp of 10 W/m^2.
void expect_source_and_rays_agree(const Scene& scene, double element_size = 0.25) {
  const auto l = lit(scene, {.element_size = element_size});
  const FormFactorSettings settings{.rays = 4096};
  LightScene rays = *l->light;
  rays.emitters.clear();
  rays.emitter_tree = {};
  std::fill(rays.direct_sides.begin(), rays.direct_sides.end(), std::uint8_t{0});
  const std::vector<Rgb> by_rays = gathered_emission(rays, assemble_transport(rays, settings));
  const FormFactors factors = assemble_transport(*l->light, settings);
  const std::vector<Rgb> gathered = gathered_emission(*l->light, factors);
  const DirectIrradiance direct = direct_irradiance(*l->light, factors.covered, {});
  for (const char* node : {"x0", "x1", "y0", "z0", "z1"}) {
    const double expected = mean_over(*l, by_rays, node).g;
    const double found = mean_over(*l, direct.irradiance, node).g + mean_over(*l, gathered, node).g;
    const double hits = double(elements_of(*l, node).size()) * settings.rays * expected / 10.0;
    EXPECT_GT(hits, 100.0) << node;
    EXPECT_NEAR(found, expected, (4.0 / std::sqrt(hits) + 0.002) * expected) << node;
  }
}

TEST(HostileMirrors, ASliver) {
  for (const double width : {1e-2, 1e-5, 1e-9, 1e-13}) {
    Scene with = black_room(), without = black_room();
    add_polygon(with, "sliver", upright(0.01, 0.5, 1.0, 1.5, 1.0 + width), mirror(1.0));
    add_polygon(without, "sliver", upright(0.01, 0.5, 1.0, 1.5, 1.0 + width), black);
    const auto bright = direct_on(with, "y0"), dark = direct_on(without, "y0");
    double gain = 0.0, sum = 0.0;
    for (std::size_t e = 0; e < bright.size(); ++e) {
      EXPECT_TRUE(std::isfinite(bright[e]));
      gain += bright[e] - dark[e];
      sum += dark[e];
    }
    // A strip of width w takes no more than its part of the hemisphere.
    EXPECT_GE(gain, 0.0) << width;
    EXPECT_LE(gain, 20.0 * width * sum) << width;
  }
}

TEST(HostileMirrors, ASheetSeenEdgeOn) {
  // It hangs in the middle of the room,
  // in the plane of elements' edges, and reflects on both sides or one.
  for (const bool both : {false, true}) {
    Scene scene = black_room();
    add_polygon(scene, "sheet", upright(0.5, 0.5, 0.5, 1.5, 1.5),
                both ? double_sided(mirror(0.9)) : mirror(0.9));
    expect_source_and_rays_agree(scene);
  }
}

// A lamp whose edge lies on a perfect mirror wall is, with its image, one lamp of twice the size.
TEST(HostileMirrors, AnEmitterThatTouchesItsMirror) {
  Scene half, whole;
  add_room(half, Point3(0.0), {1.0, 1.0, 1.0}, {mirror(1.0), black, black, black, black, black});
  add_room(whole, {-1.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {black, black, black, black, black, black});
  const Material glow = diffuse(0.0, 10.0);
  add_polygon(half, "lamp", {{0, 0.9, 0.3}, {0.3, 0.9, 0.3}, {0.3, 0.9, 0.6}, {0, 0.9, 0.6}}, glow);
  add_polygon(whole, "lamp", {{-0.3, 0.9, 0.3}, {0.3, 0.9, 0.3}, {0.3, 0.9, 0.6}, {-0.3, 0.9, 0.6}},
              glow);
  // The wall opposite has the same elements in either room, with other points in them;
  // nothing stands in the way.
  const DirectSettings fine{.points = 512, .max_points = 512};
  const auto mirrored = direct_on(half, "x1", fine), real = direct_on(whole, "x1", fine);
  ASSERT_EQ(mirrored.size(), real.size());
  for (std::size_t e = 0; e < real.size(); ++e)
    EXPECT_NEAR(mirrored[e], real[e], 2e-3 * real[e]) << e;
}

// What pierces a mirror is cut by it:
// the half of the lamp before it is mirrored, the half behind is not.
TEST(HostileMirrors, AnEmitterThatCrossesTheMirror) {
  Scene scene = black_room();
  add_polygon(scene, "sheet", upright(1.0, 0.3, 0.3, 1.95, 1.7), mirror(1.0));
  expect_source_and_rays_agree(scene);
}

/// The mirrored part of the direct light on the floor: with the mirror, less with a black one.
std::vector<double> mirrored_light(const std::vector<std::vector<Point3>>& pieces) {
  Scene with = black_room(), without = black_room();
  for (const auto& piece : pieces) {
    add_polygon(with, "piece", piece, mirror(0.9));
    add_polygon(without, "piece", piece, black);
  }
  auto light = direct_on(with, "y0");
  const auto dark = direct_on(without, "y0");
  for (std::size_t e = 0; e < light.size(); ++e)
    light[e] -= dark[e];
  return light;
}

// A frame around a hole and what fills the hole, and the two parts of an L,
// are together one rectangle: nothing obstructs,
// so the closed form adds up to rounding (the pieces lie a centimetre before the wall).
TEST(HostileMirrors, HoledAndNonConvexMirrorsAddUp) {
  const std::vector<std::vector<Point3>> frame{
      upright(0.01, 0.4, 0.4, 0.8, 1.6), upright(0.01, 1.2, 0.4, 1.6, 1.6),
      upright(0.01, 0.8, 0.4, 1.2, 0.8), upright(0.01, 0.8, 1.2, 1.2, 1.6)};
  const auto whole = mirrored_light({upright(0.01, 0.4, 0.4, 1.6, 1.6)});
  const auto around = mirrored_light(frame),
             middle = mirrored_light({upright(0.01, 0.8, 0.8, 1.2, 1.2)});
  const auto l_shape = mirrored_light({frame[0], frame[2]}),
             rest = mirrored_light({frame[1], frame[3]});
  double sum = 0.0;
  for (std::size_t e = 0; e < whole.size(); ++e) {
    sum += whole[e];
    // Elements whose points were doubled until they settled
    // may have taken different numbers of them.
    const double tolerance = 0.02 * whole[e] + 1e-3;
    EXPECT_NEAR(around[e] + middle[e], whole[e], tolerance) << e;
    EXPECT_NEAR(l_shape[e] + rest[e] + middle[e], whole[e], tolerance) << e;
  }
  EXPECT_GT(sum, 1.0);
}

TEST(HostileMirrors, AThousandTilesAreOneMirror) {
  Scene quad = black_room(), tiles = black_room();
  add_polygon(quad, "mirror", upright(0.01, 0.2, 0.2, 1.8, 1.8), mirror(0.9));
  constexpr int n = 32;
  const auto at = [](int k) { return 0.2 + 1.6 * k / n; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add_polygon(tiles, "tile", upright(0.01, at(i), at(j), at(i + 1), at(j + 1)), mirror(0.9));
  const auto one = direct_on(quad, "y0"), many = direct_on(tiles, "y0");
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t e = 0; e < one.size(); ++e)
    EXPECT_NEAR(many[e], one[e], 1e-9 * one[e]) << e; // corners of windows differ by rounding
  const auto l = lit(tiles, {.element_size = 0.5});
  EXPECT_EQ(l->plan.mirrors.mirrors.size(), 1U);
  EXPECT_EQ(l->plan.worlds.worlds.size(), 2U);
}

// Five hundred tilts: the work is bounded, it is said what was done, and no light is lost.
TEST(HostileMirrors, FiveHundredTilts) {
  Scene scene = black_room();
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const Point3 c = random.in_box({0.1, 0.1, 0.1}, {1.9, 1.5, 1.9});
    const Vec3 u = 0.04 * random.direction();
    const Vec3 v = 0.04 * glm::normalize(glm::cross(u, random.direction()));
    add_polygon(scene, "chip" + std::to_string(k), {c - u - v, c + u - v, c + u + v, c - u + v},
                mirror(0.9));
  }
  const auto l = lit(scene, {.element_size = 0.5});
  EXPECT_LE(l->plan.worlds.worlds.size(), 129U);
  ASSERT_FALSE(l->plan.warnings.empty());
  const auto told = std::ranges::find_if(l->plan.warnings, [](const std::string& warning) {
    return warning.find("chip0") != std::string::npos &&
           warning.find("followed by rays") != std::string::npos;
  });
  ASSERT_NE(told, l->plan.warnings.end());
  EXPECT_NE(told->find("500 planes"), std::string::npos) << *told;
  EXPECT_LT(told->size(), 300U) << *told;
  expect_source_and_rays_agree(scene, 0.5);
}

} // namespace
} // namespace meninas::test
