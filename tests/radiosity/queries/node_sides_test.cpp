// Which sides of double-sided nodes count in form factors, and what is said of the others.
#include "radiosity/queries/gltf_node_factors.h"
#include "tests/form_factors/asked_factors.h"
#include "tests/support/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace meninas::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two parallel unit squares one apart: Howell, C-11.
constexpr double parallel_squares = 0.1998248957;

/// The unit square in the plane y = height; `up` says where its front is.
void add_square(Scene& scene, const std::string& name, double height, bool up,
                const Material& material) {
  std::vector<Point3> corners{{0, height, 1}, {1, height, 1}, {1, height, 0}, {0, height, 0}};
  if (!up)
    std::reverse(corners.begin(), corners.end());
  add_polygon(scene, name, corners, material);
}

const Material card = double_sided(diffuse(0.5));

Scene two_cards(bool lower_up, bool upper_up, double distance = 1.0) {
  Scene scene;
  add_square(scene, "a", 0.0, lower_up, card);
  add_square(scene, "b", distance, upper_up, card);
  return scene;
}

NodeFactorSettings counting(NodeSides sides) {
  NodeFactorSettings settings;
  settings.sides = sides;
  return settings;
}

TEST(NodeSides, TheSidesThatFaceEachOtherCount) {
  for (const bool lower_up : {false, true})
    for (const bool upper_up : {false, true}) {
      const Asked asked = ask(two_cards(lower_up, upper_up), "a", "b");
      EXPECT_NEAR(asked.factor.total.value, parallel_squares, 1e-6);
      EXPECT_DOUBLE_EQ(asked.area, 1.0);
      EXPECT_THAT(asked.not_counted, IsEmpty());
    }
}

TEST(NodeSides, ByEveryMethod) {
  NodeFactorSettings rays, cubes;
  rays.method = NodeFactorMethod::rays;
  cubes.method = NodeFactorMethod::hemicube;
  const Scene scene = two_cards(false, true);
  for (const auto& settings : {rays, cubes}) {
    const Asked asked = ask(scene, "a", "b", settings);
    EXPECT_NEAR(asked.factor.total.value, parallel_squares, 4.0 * asked.factor.total.error);
    EXPECT_LT(asked.factor.total.error, 0.05);
  }
}

// However little of its rays meet it: F = 1 / (pi d^2) to order 1 / d^2.
TEST(NodeSides, WhatIsFarAwayIsFound) {
  EXPECT_NEAR(ask(two_cards(false, true, 1e3), "a", "b").factor.total.value,
              1e-6 / std::numbers::pi, 1e-11);
}

TEST(NodeSides, AsAsked) {
  const auto factor = [](bool lower_up, bool upper_up, NodeSides sides) {
    return ask(two_cards(lower_up, upper_up), "a", "b", counting(sides)).factor.total.value;
  };
  EXPECT_NEAR(factor(true, false, NodeSides::front), parallel_squares, 1e-6);
  EXPECT_EQ(factor(false, true, NodeSides::front), 0.0);
  EXPECT_EQ(factor(true, true, NodeSides::front), 0.0) << "the front of a sees the back of b";
  EXPECT_NEAR(factor(false, true, NodeSides::back), parallel_squares, 1e-6);
  EXPECT_EQ(factor(true, false, NodeSides::back), 0.0);
  EXPECT_NEAR(factor(true, false, NodeSides::both), 0.5 * parallel_squares, 1e-6);
  EXPECT_DOUBLE_EQ(ask(two_cards(true, true), "a", "b", counting(NodeSides::both)).area, 2.0);
}

TEST(NodeSides, BlackBacksAreSaid) {
  Scene scene;
  add_square(scene, "a", 0.0, true, diffuse(0.5));
  add_square(scene, "b", 1.0, true, diffuse(0.5));
  const Asked up = ask(scene, "a", "b"), down = ask(scene, "b", "a");
  EXPECT_EQ(up.factor.total.value, 0.0);
  EXPECT_THAT(up.not_counted, ::testing::Contains(HasSubstr("receiver that are single-sided")));
  EXPECT_EQ(down.factor.total.value, 0.0);
  EXPECT_THAT(down.not_counted, ::testing::Contains(HasSubstr("sender that are single-sided")));
  EXPECT_THROW(ask(scene, "a", "b", counting(NodeSides::back)), std::exception);
}

std::array<Material, 6> walls_of(const Material& material) {
  return {material, material, material, material, material, material};
}

/// By node, what arrives at all nodes.
std::vector<double> row_sums(const Scene& scene, NodeSides sides = NodeSides::facing) {
  std::vector<NodeSet> nodes;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n)
    nodes.push_back({NodeId{n}});
  const SurfaceModel surfaces = find_surfaces(scene);
  std::vector<double> sums;
  for (const NodeSet& from : nodes) {
    double sum = 0.0;
    for (const auto& factor :
         node_form_factors(scene, surfaces, from, nodes, counting(sides)).to)
      sum += factor.total.value;
    sums.push_back(sum);
  }
  return sums;
}

/// The rectangle [x0, x1] x [0, 1] in the plane y = height, its front up.
void add_strip(Scene& scene, const std::string& name, double x0, double x1, double height) {
  add_polygon(scene, name, {{x0, height, 1}, {x1, height, 1}, {x1, height, 0}, {x0, height, 0}},
              card);
}

// Two sheets that overlap are, to the other, one that is as long as both: a sheet counted twice
// where the two overlap would give up to a third more, or a mean over an area that is not there.
TEST(NodeSides, FacesThatLieOnOneAnotherCountOnce) {
  Scene whole, overlapping;
  add_strip(whole, "a", 0.0, 3.0, 0.0);
  add_strip(whole, "b", 0.0, 3.0, 1.0);
  add_strip(overlapping, "a", 0.0, 2.0, 0.0);
  add_strip(overlapping, "a", 1.0, 3.0, 0.0);
  add_strip(overlapping, "b", 0.0, 2.5, 1.0);
  add_strip(overlapping, "b", 0.5, 3.0, 1.0);
  add_strip(overlapping, "b", 1.0, 2.0, 1.0);
  for (const auto method : {NodeFactorMethod::analytic, NodeFactorMethod::rays}) {
    NodeFactorSettings settings;
    settings.method = method;
    const Asked asked = ask(overlapping, "a", "b", settings);
    // The analytic method is within its accuracy, rays within four standard errors.
    EXPECT_NEAR(asked.factor.total.value, ask(whole, "a", "b").factor.total.value,
                4.0 * asked.factor.total.error + 2.0 * settings.accuracy);
    EXPECT_NEAR(asked.area, 3.0, 1e-12);
  }
}

// Two crossing boxes a thousandth as high as wide, whose bottoms and tops lie in two planes: from
// inside nearly all that is seen is the other plane. What is counted twice would exceed one.
TEST(NodeSides, CrossingBoxesOfOneHeightSeeNoMoreThanAll) {
  Scene scene;
  add_room(scene, {0, 0, 0}, {1, 1, 1e-3}, walls_of(card));
  add_room(scene, {0.5, 0.25, 0}, {1.5, 0.75, 1e-3}, walls_of(card));
  for (const double sum : row_sums(scene, NodeSides::front))
    EXPECT_LE(sum, 1.0 + 6.0 * NodeFactorSettings{}.accuracy) << "six factors of that accuracy";
}

// A sheet from floor to ceiling makes two closed rooms of one: all that is sent arrives.
// The tolerance is that of the sum of seven factors.
TEST(NodeSides, RoomsWithAPartitionClose) {
  for (const Material& wall : {diffuse(0.5), double_sided(diffuse(0.5))}) {
    Scene scene;
    add_room(scene, {0, 0, 0}, {3, 2, 2}, walls_of(wall));
    add_polygon(scene, "sheet", {{1, 0, 0}, {1, 0, 2}, {1, 2, 2}, {1, 2, 0}}, card);
    for (const double sum : row_sums(scene))
      EXPECT_NEAR(sum, 1.0, 1e-3);
    if (!wall.double_sided) {
      const std::vector<double> fronts = row_sums(scene, NodeSides::front);
      EXPECT_LT(*std::ranges::min_element(fronts), 0.95) << "the sheet's back takes its share";
    }
  }
}

/// Walls around an L, double-sided, seen from the inside in front.
Scene l_shaped_room(const Material& wall) {
  Scene scene;
  const std::vector<Vec2> outline{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = outline[k], b = outline[(k + 1) % outline.size()];
    add_polygon(scene, "wall" + std::to_string(k),
                {{a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, 2, b.y}, {a.x, 2, a.y}}, wall);
  }
  for (const double y : {0.0, 2.0}) {
    std::vector<Point3> wide{{0, y, 1}, {3, y, 1}, {3, y, 0}, {0, y, 0}},
        deep{{0, y, 3}, {1, y, 3}, {1, y, 1}, {0, y, 1}};
    if (y > 0.0) {
      std::ranges::reverse(wide);
      std::ranges::reverse(deep);
    }
    const std::string name = y > 0.0 ? "ceiling" : "floor";
    add_polygon(scene, name + " wide", wide, wall);
    add_polygon(scene, name + " deep", deep, wall);
  }
  return scene;
}

// Outside of the room two walls see each other, and out of the scene.
TEST(NodeSides, OuterWallsDoNotCountBesideInnerOnes) {
  const Scene one = l_shaped_room(diffuse(0.5)), both = l_shaped_room(card);
  for (const double sum : row_sums(both))
    EXPECT_NEAR(sum, 1.0, 2e-3);
  for (const char* to : {"wall0", "wall3", "floor deep"}) {
    const Asked asked = ask(both, "wall2", to);
    EXPECT_NEAR(asked.factor.total.value, ask(one, "wall2", to).factor.total.value, 1e-4) << to;
  }
  EXPECT_THAT(ask(both, "wall2", "wall3").not_counted,
              ElementsAre(HasSubstr("sides that see out of the scene do not count")));
}

// Exporters write furniture double-sided: its inside dilutes nothing.
TEST(NodeSides, AClosedBoxSendsFromItsOutside) {
  Scene scenes[2];
  for (int k = 0; k < 2; ++k) {
    const Material wall = k == 0 ? diffuse(0.5) : card;
    add_room(scenes[k], {0, 0, 0}, {3, 3, 3}, walls_of(wall));
    add_box(scenes[k], "box", {1, 0.5, 1}, {2, 1.5, 2}, wall);
    for (Triangle& triangle : scenes[k].triangles)
      if (index(triangle.node) > 6)
        triangle.node = NodeId{6};
    scenes[k].nodes.resize(7);
    scenes[k].nodes[6].name = "box";
  }
  const Asked one = ask(scenes[0], "box", "y0"), both = ask(scenes[1], "box", "y0");
  EXPECT_DOUBLE_EQ(both.area, 6.0);
  EXPECT_NEAR(both.factor.total.value, one.factor.total.value, 1e-4);
  for (const double sum : row_sums(scenes[1]))
    EXPECT_NEAR(sum, 1.0, 2e-3);
  // In a row of the matrix, too, where the box is asked for itself.
  const std::array to{NodeSet{NodeId{6}}, NodeSet{NodeId{2}}};
  const NodeFactors row = node_form_factors(scenes[1], find_surfaces(scenes[1]), to[0], to);
  EXPECT_EQ(row.to[0].total.value, 0.0);
  EXPECT_NEAR(row.to[1].total.value, one.factor.total.value, 1e-4);
}

TEST(NodeSides, AGroupIsTheMeanOfItsNodesByArea) {
  Scene scene = two_cards(true, false);
  add_polygon(scene, "c", {{2, 0, 3}, {4, 0, 3}, {4, 0, 0}, {2, 0, 0}}, card);
  const SurfaceModel surfaces = find_surfaces(scene);
  const NodeSet a{NodeId{0}}, c{NodeId{2}}, group{NodeId{0}, NodeId{2}};
  const std::array b{NodeSet{NodeId{1}}};
  const auto factor = [&](const NodeSet& from) {
    return node_form_factors(scene, surfaces, from, b).to[0].total.value;
  };
  EXPECT_NEAR(factor(group), (factor(a) + 6.0 * factor(c)) / 7.0, 1e-5);
  const std::array to_group{group};
  EXPECT_NEAR(node_form_factors(scene, surfaces, b[0], to_group).to[0].total.value,
              factor(a) + 6.0 * factor(c), 1e-4)
      << "reciprocity, A_b = 1";
}

} // namespace
} // namespace meninas::test
