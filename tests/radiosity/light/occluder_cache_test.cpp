// Shadows of blockers that rays have met:
// what is left of an image in closed form, without noise once they are known, and true before.
#include "radiosity/light/occluder_cache.h"
#include "form_factors/point_form_factor.h"
#include "radiosity/light/element_light.h"
#include "radiosity/light/shared_light.h"
#include "scenes/sampling.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace meninas::test {
namespace {

constexpr double emitted = 10.0;

/// A horizontal rectangle at height y that faces down.
std::vector<Point3> facing_down(double x0, double x1, double z0, double z1, double y) {
  return {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}};
}

/// A lamp over a floor, plates below the lamp, and nothing that reflects.
Scene lamp_room(const std::vector<std::vector<Point3>>& plates) {
  Scene scene;
  add_polygon(scene, "floor", {{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}}, diffuse(0.0));
  add_polygon(scene, "lamp", facing_down(-1, 1, -1, 1, 2), diffuse(0.0, emitted));
  for (const auto& plate : plates)
    add_polygon(scene, "plate", plate, diffuse(0.0));
  return scene;
}

/// The mirror x = -4, which faces the lamp room, with all of it shown.
void add_mirror(Scene& scene) {
  add_polygon(scene, "mirror", {{-4, -1, 6}, {-4, -1, -6}, {-4, 9, -6}, {-4, 9, 6}}, mirror(1.0));
}

Receiver on_floor(const LitScene& lit, double x, double z) {
  const MeshSide& side =
      lit.mesh.sides[index(lit.mesh.side_of_element[elements_of(lit, "floor")[0]])];
  const Patch& patch = lit.surfaces.patches[index(side.patch)];
  return {{x, 0.0, z}, {0.0, 1.0, 0.0}, lit.surfaces.surfaces[index(patch.surface)].plane_class};
}

/// Means at the one point, as many times.
std::vector<double> means_at(const LitScene& lit, const Receiver& receiver, int count,
                             std::uint32_t seed, SharedLightSettings settings = {.caches_occluders = true}) {
  SharedLightWorkspace work;
  std::vector<double> means;
  for (int k = 0; k < count; ++k) {
    std::uint32_t next = 0;
    const auto point = [&]() -> NumberedPoint { return {receiver, next++}; };
    const auto mean = mean_direct_irradiance(*lit.light, point, settings,
                                        hash(seed, static_cast<std::uint32_t>(k)), work);
    means.push_back(mean.total.g);
  }
  return means;
}

double factor(const Receiver& receiver, const std::vector<Point3>& polygon) {
  return point_form_factor(receiver.position, receiver.normal, polygon);
}

// The shadow of a plate at half the lamp's height,
// on the lamp, is twice as large and mirrored about the point.
struct Plate {
  double x0 = 0.1, x1 = 0.4, z0 = -0.2, z1 = 0.3;

  std::vector<Point3> polygon() const { return facing_down(x0, x1, z0, z1, 1.0); }
  std::vector<Point3> shadow(const Receiver& from) const {
    const auto on_lamp = [](double plate, double point) {
      return std::clamp(2.0 * plate - point, -1.0, 1.0);
    };
    const auto& [x, y, z] = std::tuple(from.position.x, from.position.y, from.position.z);
    return facing_down(on_lamp(x0, x), on_lamp(x1, x), on_lamp(z0, z), on_lamp(z1, z), 2.0);
  }
};

TEST(OccluderCache, LeaveTheClosedFormOfWhatTheyDoNotHide) {
  const Plate plate;
  const auto room = lit(lamp_room({plate.polygon()}), {.element_size = 3.0});
  const auto lamp = facing_down(-1, 1, -1, 1, 2);
  for (const auto& [x, z] : {std::pair(0.0, 0.0), {0.35, 0.1}, {-0.5, 0.7}, {1.3, -0.4}}) {
    const Receiver receiver = on_floor(*room, x, z);
    const double exact =
        emitted * (factor(receiver, lamp) - factor(receiver, plate.shadow(receiver)));
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      const auto means = means_at(*room, receiver, 8, seed);
      // The first one only has its rays;
      // that the last one knows the plate takes a ray that has met it, of a hundred.
      EXPECT_NEAR(means.back(), exact, 1e-12 * exact) << x << " " << z;
      EXPECT_GT(std::abs(means.front() - exact), 1e-9 * exact) << "or else nothing is learned";
    }
  }
}

std::vector<Point3> behind_mirror(const std::vector<Point3>& polygon) {
  std::vector<Point3> image;
  for (const Point3& corner : polygon)
    image.insert(image.begin(), {-8.0 - corner.x, corner.y, corner.z});
  return image;
}

// A frame that hides a strip of 2 % of a lamp: of sixteen rays none meets it in 72 of 100 places, and all of the lamp
// would count. Rays to the rim of the lamp find it at once, in the mirror too.
TEST(OccluderCache, FramesThatHideAThinStripAreFound) {
  const Plate frame{0.48, 0.7, -0.7, 0.7};
  Scene scene = lamp_room({frame.polygon()});
  const auto lamp = facing_down(-1, 1, -1, 1, 2);
  const auto room = lit(scene, {.element_size = 3.0});
  add_mirror(scene);
  const auto mirrored = lit(scene, {.element_size = 3.0});
  const SharedLightSettings settings{.points = 1,
                                     .max_points = 8,
                                     .rays = 16,
                                     .unsure = 1.0,
                                     .one_place = true,
                                     .caches_occluders = true};
  const Receiver receiver = on_floor(*room, 0.0, 0.0);
  const double exact = emitted * (factor(receiver, lamp) - factor(receiver, frame.shadow(receiver)));
  for (std::uint32_t seed = 0; seed < 32; ++seed) {
    // The second mean is the first that knows what the first has met.
    EXPECT_NEAR(means_at(*room, receiver, 2, seed, settings).back(), exact, 1e-12 * exact) << seed;
    const double more = means_at(*mirrored, on_floor(*mirrored, 0.0, 0.0), 2, seed, settings).back() - exact;
    // Through the mirror the frame is beside the lamp, and hides nothing of it.
    EXPECT_NEAR(more, emitted * factor(receiver, behind_mirror(lamp)), 1e-12 * exact) << seed;
  }
}

// The same of means over elements, which learn anew for each: the middle of a small one tells its mean to a thousandth.
// Without the rim eight of them have the strip as well.
TEST(OccluderCache, ElementsFindThinStripsToo) {
  const Plate frame{0.48, 0.7, -0.7, 0.7};
  const auto room = lit(lamp_room({frame.polygon()}), {.element_size = 0.05});
  const auto lamp = facing_down(-1, 1, -1, 1, 2);
  SharedLightWorkspace work;
  int tried = 0;
  for (const std::size_t element : elements_of(*room, "floor")) {
    const ElementCorners& corners = room->mesh.corners[element];
    const Point3 middle =
        0.5 * (room->mesh.vertices[index(corners[0])] + room->mesh.vertices[index(corners[2])]);
    if (glm::length(middle) > 0.2)
      continue;
    const Receiver receiver = on_floor(*room, middle.x, middle.z);
    const double exact = emitted * (factor(receiver, lamp) - factor(receiver, frame.shadow(receiver)));
    const MeanLight mean =
        direct_irradiance(*room->light, static_cast<ElementId>(element), 0, {}, work);
    EXPECT_NEAR(mean.total.g, exact, 2e-3 * exact) << middle.x << " " << middle.z;
    ++tried;
  }
  EXPECT_GT(tried, 20);
}

TEST(OccluderCache, StandWhereMirrorsShowThem) {
  // A plate in front of the mirror, on both legs of the path by way of it,
  // and one on the way from the mirror to the lamp.
  const auto lamp = facing_down(-1, 1, -1, 1, 2);
  for (const auto& [x, low, high] : {std::tuple(-3.5, 0.2, 0.9), {-1.5, 1.2, 1.7}}) {
    const std::vector<Point3> plate{{x, low, -0.3}, {x, low, 0.4}, {x, high, 0.4}, {x, high, -0.3}};
    const Material both = double_sided(diffuse(0.0));
    Scene scene = lamp_room({}), unfolded = lamp_room({});
    add_polygon(scene, "plate", plate, both);
    add_mirror(scene);
    add_polygon(unfolded, "plate", plate, both);
    add_polygon(unfolded, "plate behind", behind_mirror(plate), both);
    add_polygon(unfolded, "lamp behind", behind_mirror(lamp), diffuse(0.0, emitted));
    const auto room = lit(scene, {.element_size = 3.0}),
               doubled = lit(unfolded, {.element_size = 3.0});
    ASSERT_EQ(room->plan.worlds.worlds.size(), 2u);

    const Receiver here = on_floor(*room, -2.0, 0.1), there = on_floor(*doubled, -2.0, 0.1);
    const double mirrored = means_at(*room, here, 12, 5).back();
    const double expected = means_at(*doubled, there, 12, 6).back();
    EXPECT_NEAR(mirrored, expected, 1e-10 * expected) << x;
    const double without = emitted * (factor(here, lamp) + factor(here, behind_mirror(lamp)));
    EXPECT_LT(mirrored, 0.99 * without) << "or else nothing is in the way";
  }
}

TEST(OccluderCache, MeansAreTrueWhetherTheyAreKnownOrNot) {
  // Slats of which no ray knows all: the mean over many seeds is that of the slats' shadows, of the
  // first that a workspace takes, which knows none, and of the second and third, which know some.
  std::vector<std::vector<Point3>> slats;
  const Receiver origin{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  double open = factor(origin, facing_down(-1, 1, -1, 1, 2));
  for (int k = -6; k < 6; ++k) {
    const Plate slat{0.08 * k + 0.01, 0.08 * k + 0.03, -0.45, 0.45};
    slats.push_back(slat.polygon());
    open -= factor(origin, slat.shadow(origin));
  }
  const auto room = lit(lamp_room(slats), {.element_size = 3.0});
  const Receiver receiver = on_floor(*room, 0.0, 0.0);
  for (const int count : {1, 2, 3}) {
    constexpr int runs = 400;
    double sum = 0.0, squares = 0.0;
    for (int seed = 0; seed < runs; ++seed) {
      // All points are looked at: what settles early is a matter of its own.
      const double mean = means_at(*room, receiver, count, static_cast<std::uint32_t>(seed),
                                   {.points = 16, .max_points = 16, .caches_occluders = true})
                              .back();
      sum += mean;
      squares += mean * mean;
    }
    const double mean = sum / runs;
    const double deviation = std::sqrt((squares / runs - mean * mean) / runs);
    EXPECT_NEAR(mean, emitted * open, 4.0 * deviation + 1e-9) << count << ": 4 sigma";
    EXPECT_LT(deviation, 0.004 * mean) << "or else nothing is tested";
  }
}

} // namespace
} // namespace meninas::test
