// One lamp of a solution that knows its lamps apart is the solution of the scene in which the others are dark:
// by material, behind a pane, behind and inside of what is translucent, and where the lamp is the sky.
#include "radiosity/relight.h"
#include "raytrace/two_pass.h"
#include "scenes/lamps.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"
#include "tests/support/translucent.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

struct LampsCase {
  std::string name;
  Scene scene;
  std::vector<std::string> lamps;
  LampGrouping grouping = LampGrouping::node;
};

std::vector<Point3> square(Point3 middle, Vec3 u, Vec3 v) {
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

/// Two lamps of one material and one of another, which has a light of its name beside it.
LampsCase by_material() {
  Scene scene = half_room();
  const Material warm = diffuse(Rgb(0.0), Rgb(20.0, 10.0, 5.0)), cold = diffuse(Rgb(0.0), Rgb(3.0, 8.0, 20.0));
  add_polygon(scene, "one", square({0.6, 2.39, 0.6}, {0.1, 0.0, 0.0}, {0.0, 0.0, 0.1}), warm);
  const MaterialId shared = scene.triangles.back().material;
  add_polygon(scene, "two", square({1.5, 2.39, 2.4}, {0.1, 0.0, 0.0}, {0.0, 0.0, 0.1}), warm);
  for (std::size_t k = scene.triangles.size() - 2; k < scene.triangles.size(); ++k)
    scene.triangles[k].material = shared;
  add_polygon(scene, "three", square({1.99, 1.2, 1.0}, {0.0, 0.0, 0.2}, {0.0, 0.2, 0.0}), cold);
  scene.materials[index(shared)].name = "warm";
  scene.materials.back().name = "cold";
  scene.lights.push_back({.name = "cold", .intensity = Rgb(0.2, 0.4, 0.8), .position = {0.5, 1.5, 1.5}});
  return {"ByMaterial", std::move(scene), {"lamp", "warm", "cold"}, LampGrouping::material};
}

/// The green pane stands between both lamps; the second is seen through it alone from before.
LampsCase behind_a_pane() {
  Scene scene = glazed_room();
  add_polygon(scene, "behind", square({1.0, 0.8, 0.01}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}),
              diffuse(Rgb(0.0), Rgb(8.0, 6.0, 10.0)));
  scene.lights.push_back({.name = "bulb behind", .intensity = Rgb(0.5), .position = {0.6, 1.0, 0.4}});
  return {"BehindAPane", std::move(scene), {"lamp", "behind", "bulb behind"}};
}

/// A curtain before a lamp and a bulb, and a paper that glows itself.
LampsCase behind_a_curtain() {
  Scene scene = half_room();
  add_polygon(scene, "curtain", {{0.3, 0.9, 0.6}, {1.7, 0.9, 0.6}, {1.7, 2.2, 1.0}, {0.3, 2.2, 1.0}},
              translucent({0.7, 0.5, 0.4}, 0.5, {0.9, 0.6, 0.5}));
  add_polygon(scene, "behind", square({1.0, 1.5, 0.01}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}),
              diffuse(Rgb(0.0), Rgb(6.0, 9.0, 12.0)));
  scene.lights.push_back({.name = "bulb", .intensity = Rgb(0.4), .position = {1.4, 1.6, 0.4}});
  Material paper = translucent(Rgb(0.6), 0.4, Rgb(0.8, 0.7, 0.6));
  paper.emission = Rgb(0.8, 0.5, 0.2);
  add_polygon(scene, "paper", square({1.4, 1.0, 2.0}, {0.2, 0.0, 0.0}, {0.0, 0.2, 0.1}), paper);
  return {"BehindACurtain", std::move(scene), {"lamp", "behind", "paper", "bulb"}};
}

/// A bulb in a closed lantern of paper: all of its light comes through.
LampsCase in_a_lantern() {
  Scene scene = half_room();
  add_box(scene, "lantern", {1.2, 1.2, 1.8}, {1.6, 1.6, 2.2}, translucent(Rgb(0.8), 0.5, Rgb(0.9, 0.8, 0.6)));
  scene.lights.push_back({.name = "bulb", .intensity = Rgb(1.0), .position = {1.4, 1.4, 2.0}});
  return {"InALantern", std::move(scene), {"lamp", "bulb"}};
}

/// An even sky through an opening in the wall z = 3, beside the lamp of the room.
LampsCase by_a_window() {
  Scene scene;
  const Material grey = diffuse(Rgb(0.6, 0.5, 0.4));
  add_room(scene, Point3(0.0), {2.0, 2.4, 3.0}, {grey, grey, grey, grey, grey, grey});
  scene.triangles.resize(scene.triangles.size() - 2); // z1
  const std::array outer{Point3(0, 0, 3), Point3(0, 2.4, 3), Point3(2, 2.4, 3), Point3(2, 0, 3)};
  const std::array inner{Point3(0.5, 1.0, 3), Point3(0.5, 2.0, 3), Point3(1.5, 2.0, 3), Point3(1.5, 1.0, 3)};
  for (std::size_t k = 0; k < 4; ++k)
    add_polygon(scene, "z1." + std::to_string(k), {outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]}, grey);
  add_polygon(scene, "lamp", square({1.0, 2.39, 1.5}, {0.2, 0.0, 0.0}, {0.0, 0.0, 0.2}), diffuse(0.0, 10.0));
  scene.background.constant = Rgb(0.5, 1.0, 2.0);
  return {"ByAWindow", std::move(scene), {"lamp", "sky"}};
}

PassOneSettings settings_of(LampGrouping grouping) {
  PassOneChoice choice;
  choice.elements = 1200;
  choice.rays = 256;
  choice.lamps = grouping;
  PassOneSettings settings = pass_one_settings(choice);
  settings.interpolation.shadow_bend = 0.0; // so that the meshes are one
  return settings;
}

double sum_of(const std::vector<glm::vec3>& values) {
  double sum = 0.0;
  for (const glm::vec3& value : values)
    sum += double{value.r} + double{value.g} + double{value.b};
  return sum;
}

class LampsAlone : public testing::TestWithParam<LampsCase> {};

// Samples fall where all lamps together have noise, and elsewhere for one alone: the bounds are what two such
// solutions of one scene differ by (lamps_test.cpp), and 1200 elements are 10 cm wide.
TEST_P(LampsAlone, AreTheSceneWithoutTheOthers) {
  const auto& [name, scene, names, grouping] = GetParam();
  const PassOneSettings settings = settings_of(grouping);
  const auto apart = prepare_scene(scene, settings);
  const RadiositySolution solution = solve_pass_one(apart->light(), settings);
  const LampGroups lamps = find_lamps(scene, grouping);
  ASSERT_EQ(lamps.names, names);
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    SCOPED_TRACE(lamps.names[l]);
    std::vector<Rgb> factors(lamps.size(), Rgb(0.0));
    factors[l] = Rgb(1.0, 0.5, 2.0);
    const auto alone = prepare_scene(relit(scene, lamps, factors), settings);
    const RadiositySolution truth = solve_pass_one(alone->light(), settings);
    const std::vector<glm::vec3> found = relit(solution.field, factors).irradiance;
    ASSERT_EQ(found.size(), truth.field.irradiance.size());
    const double expected = sum_of(truth.field.irradiance);
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(sum_of(found), expected, 0.01 * expected);
    double squares = 0.0;
    for (std::size_t v = 0; v < found.size(); ++v) {
      const glm::dvec3 difference(found[v] - truth.field.irradiance[v]);
      squares += glm::dot(difference, difference);
    }
    const double rms = std::sqrt(squares / double(3 * found.size()));
    EXPECT_LT(rms, 0.05 * expected / double(3 * found.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, LampsAlone,
                         testing::Values(by_material(), behind_a_pane(), behind_a_curtain(), in_a_lantern(),
                                         by_a_window()),
                         [](const auto& one) { return one.param.name; });

} // namespace
} // namespace meninas::test
