#include "mirror/light_choice.h"
#include "tests/mirror/lambert.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A room with some mirror walls, and emitters of its own.
struct Lamps {
  Scene scene;
  MirrorSet mirrors;
  WorldTree worlds;
  std::vector<Emitter> emitters;
  LightTree tree;
};

Lamps lamps_in(const std::array<bool, 6>& mirror_walls, std::vector<Emitter> emitters) {
  Lamps lamps;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k)
    walls[k] = mirror_walls[k] ? mirror(0.8) : diffuse(0.5);
  add_room(lamps.scene, Point3(0.0), Point3(2.0), walls);
  lamps.mirrors = find_mirrors(lamps.scene, find_surfaces(lamps.scene));
  lamps.worlds = mirror_worlds(lamps.mirrors, {.min_throughput = 0.3, .max_depth = 3});
  lamps.emitters = std::move(emitters);
  lamps.tree = make_emitter_tree(lamps.emitters);
  return lamps;
}

Emitter emitter_of(const std::vector<Point3>& corners, double radiosity) {
  Emitter emitter;
  emitter.corners = corners;
  const Vec3 area = area_vector(emitter.corners);
  emitter.area = glm::length(area);
  emitter.plane.normal = area / emitter.area;
  emitter.plane.offset = glm::dot(emitter.plane.normal, corners[0]);
  emitter.radiosity = Rgb(radiosity);
  return emitter;
}

/// 30 x 30 small lamps under the ceiling, of all brightnesses.
std::vector<Emitter> ceiling_of_lamps() {
  std::vector<Emitter> emitters;
  Random random(2);
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) {
      const double x = 0.1 + 0.06 * i, z = 0.1 + 0.06 * j;
      emitters.push_back(emitter_of(
          {{x, 1.9, z}, {x + 0.02, 1.9, z}, {x + 0.02, 1.9, z + 0.02}, {x, 1.9, z + 0.02}},
          random.between(0.1, 10.0)));
    }
  return emitters;
}

/// A sphere of triangles that glow outwards.
std::vector<Emitter> glowing_sphere(int rings) {
  std::vector<Emitter> emitters;
  const auto at = [rings](int ring, int step) {
    const double t = std::numbers::pi * ring / rings, p = std::numbers::pi * step / rings;
    return Point3(1.0) +
           0.3 * Vec3(std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < 2 * rings; ++step) {
      if (ring > 0)
        emitters.push_back(
            emitter_of({at(ring, step), at(ring, step + 1), at(ring + 1, step + 1)}, 3.0));
      if (ring + 1 < rings)
        emitters.push_back(
            emitter_of({at(ring, step), at(ring + 1, step + 1), at(ring + 1, step)}, 3.0));
    }
  return emitters;
}

double light_of(const Lamps& lamps, const Observer& observer,
                const std::vector<VirtualLight>& lights) {
  double sum = 0.0;
  for (const auto& light : lights)
    sum += light.weight * lamps.worlds.worlds[index(light.world)].throughput.r *
           lamps.emitters[light.emitter].radiosity.r *
           form_factor(observer.position, observer.normal, light.polygon);
  return sum;
}

double all_light(const Lamps& lamps, const Observer& observer) {
  std::vector<VirtualLight> lights;
  virtual_lights(lamps.worlds, lamps.emitters, observer.position, observer.normal, 0.0, lights);
  return light_of(lamps, observer, lights);
}

struct Spread {
  double mean = 0.0, deviation = 0.0; ///< relative to the truth
  std::size_t most = 0;               ///< images at a point
};

Spread spread_of(const Lamps& lamps, const Observer& observer, std::size_t budget) {
  constexpr int turns = 64;
  const double truth = all_light(lamps, observer);
  Spread spread;
  LightChoiceWorkspace work;
  std::vector<VirtualLight> lights;
  double squares = 0.0;
  for (int k = 0; k < turns; ++k) {
    sample_light_tree({lamps.worlds, lamps.emitters, lamps.tree}, observer,
                      {budget, (k + 0.5) / turns}, work, lights);
    const double found = light_of(lamps, observer, lights) / truth;
    spread.mean += found / turns;
    squares += found * found / turns;
    spread.most = std::max(spread.most, lights.size());
  }
  spread.deviation = std::sqrt(std::max(0.0, squares - spread.mean * spread.mean));
  return spread;
}

TEST(LightTree, NodesHoldTheirEmitters) {
  const auto emitters = glowing_sphere(12);
  const LightTree tree = make_emitter_tree(emitters);
  EXPECT_EQ(tree.nodes.size(), 2 * emitters.size() - 1);
  for (const auto& node : tree.nodes) {
    double power = 0.0;
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const Emitter& emitter = emitters[tree.order[k]];
      power += emitter.area * emitter.radiosity.r;
      EXPECT_GE(glm::dot(emitter.plane.normal, node.axis), node.cos_spread - 1e-12);
      for (const auto& vertex : emitter.corners)
        EXPECT_LE(glm::distance(vertex, node.centre), node.radius + 1e-12);
    }
    EXPECT_NEAR(node.power, power, 1e-12 * power);
  }
  EXPECT_TRUE(make_emitter_tree({}).nodes.empty());
}

// All offsets of the even steps together give the sum of all images:
// the choice is right on average, with mirrors and without,
// near the lamps, far from them, and where some lie below the horizon.
TEST(LightChoice, IsRightOnAverageAndNearlyRightEachTime) {
  for (const auto& mirrors :
       {std::array<bool, 6>{}, {true}, {true, false, false, false, true}, {true, true}}) {
    for (const auto& emitters : {ceiling_of_lamps(), glowing_sphere(24)}) {
      const Lamps lamps = lamps_in(mirrors, emitters);
      for (const Observer& observer : {Observer{{0.3, 0.01, 0.6}, {0, 1, 0}},
                                       {{0.01, 1.7, 0.4}, {1, 0, 0}},
                                       {{1.0, 1.85, 1.0}, {0, 1, 0}},
                                       {{1.9, 1.0, 0.2}, glm::normalize(Vec3(-1, 0.3, 1))}}) {
        if (all_light(lamps, observer) == 0.0)
          continue;
        const Spread spread = spread_of(lamps, observer, 64);
        // The mean over 64 even offsets is an integral of steps:
        // its error is far below the deviation of one.
        EXPECT_NEAR(spread.mean, 1.0, 0.25 * spread.deviation + 1e-9);
        EXPECT_LT(spread.deviation, 0.06);
        EXPECT_LT(spread_of(lamps, observer, 256).deviation, 0.03);
        // Certain ones and steps; an image that two openings show has two parts.
        EXPECT_LE(spread.most, 2U * 64U + 1U);
      }
    }
  }
}

// Who chooses again at the same point keeps the cut: the choice is the one that a fresh cut gives.
TEST(LightChoice, IsTheSameByAKeptCut) {
  for (const auto& emitters : {ceiling_of_lamps(), glowing_sphere(24)}) {
    const Lamps lamps = lamps_in({true, false, false, false, true}, emitters);
    for (const Observer& observer :
         {Observer{{0.3, 0.01, 0.6}, {0, 1, 0}}, {{0.01, 1.7, 0.4}, {1, 0, 0}}})
      for (const std::size_t afar : {std::size_t{0}, std::size_t{16}}) {
        LightChoiceWorkspace kept;
        std::vector<VirtualLight> again, fresh;
        for (int k = 0; k < 8; ++k) {
          LightChoice choice{.most = 64, .offset = (k + 0.5) / 8.0, .afar = afar, .same_point = k > 0};
          const EmitterChoice of{lamps.worlds, lamps.emitters, lamps.tree};
          sample_light_tree(of, observer, choice, kept, again);
          LightChoiceWorkspace empty;
          choice.same_point = false;
          sample_light_tree(of, observer, choice, empty, fresh);
          ASSERT_EQ(again.size(), fresh.size());
          for (std::size_t l = 0; l < again.size(); ++l) {
            EXPECT_EQ(again[l].emitter, fresh[l].emitter);
            EXPECT_EQ(again[l].world, fresh[l].world);
            EXPECT_EQ(again[l].weight, fresh[l].weight);
            EXPECT_EQ(again[l].afar, fresh[l].afar);
          }
        }
      }
  }
}

// Nodes that are seen from afar bring what their emitters do one by one, also by way of mirrors, and so
// many of these stand for them as are asked for, at most.
TEST(LightChoice, NodesFromAfarBringWhatTheirEmittersDo) {
  constexpr std::size_t asked = 16;
  constexpr int turns = 64;
  for (const auto& mirrors : {std::array<bool, 6>{}, {true}, {true, false, false, false, true}}) {
    const Lamps lamps = lamps_in(mirrors, glowing_sphere(48));
    for (const Observer& observer : {Observer{{0.3, 0.01, 0.6}, {0, 1, 0}},
                                     {{0.01, 1.7, 0.4}, {1, 0, 0}},
                                     {{1.9, 1.0, 0.2}, glm::normalize(Vec3(-1, 0.3, 1))}}) {
      double mean = 0.0;
      LightChoiceWorkspace work;
      std::vector<VirtualLight> lights;
      for (int k = 0; k < turns; ++k) {
        sample_light_tree({lamps.worlds, lamps.emitters, lamps.tree}, observer,
                          {.most = 256, .offset = (k + 0.5) / turns, .afar = asked}, work, lights);
        std::vector<VirtualLight> near;
        std::size_t standing = 0;
        for (const VirtualLight& light : lights)
          if (light.afar > 0.0) {
            ++standing;
            mean += light.afar * lamps.worlds.worlds[index(light.world)].throughput.r *
                    lamps.emitters[light.emitter].radiosity.r / turns;
          } else {
            near.push_back(light);
          }
        mean += light_of(lamps, observer, near) / turns;
        EXPECT_GT(standing, 0U);
        EXPECT_LE(standing, asked + 1);
      }
      // A disc that faces x has F = r^2 / (d^2 + r^2), from afar r^2 / d^2: off by the square of 0.2, the
      // largest radius over distance, at most. Of what is chosen besides the mean over all offsets is right.
      EXPECT_NEAR(mean / all_light(lamps, observer), 1.0, 0.2 * 0.2);
    }
  }
}

TEST(LightChoice, FewImagesAreAllTaken) {
  const Lamps lamps = lamps_in({true}, {ceiling_of_lamps()[0], ceiling_of_lamps()[77]});
  const Observer observer{{0.3, 0.01, 0.6}, {0, 1, 0}};
  const Spread spread = spread_of(lamps, observer, 4);
  EXPECT_EQ(spread.mean, 1.0);
  EXPECT_LT(spread.deviation, 1e-7);
  EXPECT_EQ(spread.most, 4U);
}

} // namespace
} // namespace meninas::test
