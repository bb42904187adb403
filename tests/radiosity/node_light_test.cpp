// Light from the source on nodes: points shared out among them bring what their elements light,
// all together, the light that they receive.
#include "radiosity/hierarchical/node_light.h"
#include "radiosity/hierarchical/node_solution.h"
#include "scenes/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

TEST(NodeLight, NodesShareTheirPoints) {
  const DirectSettings settings{.points = 16, .most_points = 256};
  const auto points = [&](std::size_t nodes) { return shared_out(settings, nodes).points; };
  EXPECT_EQ(points(1), 16);
  EXPECT_EQ(points(512), 16);
  EXPECT_EQ(points(1024), 8);
  EXPECT_EQ(points(1500), 8); // a power of two, rather too many
  EXPECT_EQ(points(8192), 1);
  EXPECT_EQ(points(1'000'000), 1);
  EXPECT_EQ(shared_out(settings, 1024).most_points, 64);
  EXPECT_EQ(shared_out(settings, 1'000'000).most_points, 1);
}

// Every element is in one node, and what is alone is.
TEST(NodeLight, NodesAreACut) {
  const Scene meninas = load_gltf(std::string(MENINAS_SOURCE_DIR) + "/scenes/gallery/meninas.gltf");
  for (const Scene& scene : {half_room(), meninas}) {
    const auto l = lit(scene, {.element_size = 0.15});
    const NodeTree tree = make_node_tree(l->mesh, l->surfaces);
    std::vector<std::uint8_t> alone(element_count(l->mesh), 0);
    for (std::size_t e = 0; e < alone.size(); e += 100)
      alone[e] = 1;
    for (const std::uint32_t most : {1U, 4U, 16U}) {
      std::vector<int> times(alone.size(), 0);
      std::uint32_t largest_node = 0;
      for (const TreeNodeId id : nodes_lit_together(tree, most, alone)) {
        const TreeNode& node = tree.nodes[index(id)];
        largest_node = std::max(largest_node, node.leaf_count);
        for (const ElementId element : elements_below(tree, id)) {
          ++times[index(element)];
          EXPECT_TRUE(alone[index(element)] == 0 || is_leaf(node)) << index(element);
        }
      }
      EXPECT_EQ(largest_node, most);
      EXPECT_EQ(std::ranges::count(times, 1), std::ssize(times));
    }
  }
}

Scene plates() {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5, 1.0));
  add_polygon(scene, "ceiling", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, diffuse(0.5));
  return scene;
}

/// A plate halfway up hides a half and more of the floor.
Scene plates_with_one_between() {
  Scene scene = plates();
  add_polygon(scene, "plate", {{0, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 1}, {0, 0.5, 1}},
              double_sided(diffuse(0.0)));
  return scene;
}

/// The light on plates of so many elements an edge, by nodes; nothing is covered.
DirectIrradiance by_nodes(const LitScene& l, std::uint32_t seed = 0) {
  const NodeTree tree = make_node_tree(l.mesh, l.surfaces);
  return light_by_nodes(*l.light, tree, std::vector<CoveredCells>(element_count(l.mesh), 0),
                        {.seed = seed}, {});
}

// F = 0.199824895698387383 (C-11).
// Of 64 x 64 nodes on the ceiling each has a point, whatever the elements are:
// the light differs by 0.2 a metre, by 1.3e-3 within a node, their mean by a 64th of that, 2e-5.
TEST(NodeLight, OnePointInEachOfManyNodesIsEnough) {
  for (const double elements : {64.0, 128.0, 256.0}) {
    const auto l = lit(plates(), {.element_size = 1.0 / elements});
    EXPECT_NEAR(mean_over(*l, by_nodes(*l).irradiance, "ceiling").g, 0.199824895698387383, 4 * 2e-5)
        << elements;
  }
}

// In the penumbra, half of the ceiling, single points are off by a third of what is there,
// the mean over 2,000 of them by 0.2 x 0.33 / 64 = 1e-3.
TEST(NodeLight, PenumbraeAreNeitherDarkerNorBrighter) {
  const auto coarse = lit(plates_with_one_between(), {.element_size = 1.0 / 32.0});
  const double many =
      mean_over(
          *coarse,
          direct_irradiance(*coarse->light, {}, {.points = 64, .most_points = 1024}).irradiance,
          "ceiling")
          .g;
  EXPECT_LT(many, 0.15);
  for (const double elements : {64.0, 128.0}) {
    const auto l = lit(plates_with_one_between(), {.element_size = 1.0 / elements});
    EXPECT_NEAR(mean_over(*l, by_nodes(*l).irradiance, "ceiling").g, many, 4 * 1e-3) << elements;
  }
}

// The sun through a window of 0.33 x 0.33 m2 onto a floor of 8 x 8 m2 in elements of 1/16 m:
// 5.3 x 5.3 of 16,384, which have all of the light, E = 1. At an edge an element is found lit
// to a 64th, and the error of 22 of them is 22^1/2 / 8 / 28: 2 % of the light at the most.
// With a point for each it is off by 8 %, by which edges are lit by chance.
TEST(NodeLight, SpotsHaveTheLightThatTheyReceive) {
  constexpr double side = 0.33, low = 3.0 + 1.0 / 37.0, high = low + side;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 8}, {8, 0, 8}, {8, 0, 0}}, diffuse(0.5));
  const auto shade = [&](double x0, double x1, double z0, double z1) {
    add_polygon(scene, "shade", {{x0, 1, z0}, {x0, 1, z1}, {x1, 1, z1}, {x1, 1, z0}},
                double_sided(diffuse(0.0)));
  };
  shade(0, low, 0, 8);
  shade(high, 8, 0, 8);
  shade(low, high, 0, low);
  shade(low, high, high, 8);
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = {0, -1, 0};
  sun.intensity = Rgb(1.0);
  scene.lights = {sun};
  const auto l = lit(scene, {.element_size = 1.0 / 16.0});
  for (std::uint32_t seed = 0; seed < 8; ++seed)
    EXPECT_NEAR(64.0 * mean_over(*l, by_nodes(*l, seed).irradiance, "floor").g, side * side,
                0.02 * side * side)
        << seed;
}

// The black shade of a lamp takes most of its light and gives none back:
// its nodes, over each of which light varies by several times, have all of their points.
// Sixteen and more for each of some twenty nodes leave 0.5 / sqrt(320) of steep light, or less.
TEST(NodeLight, ShadesAbsorbTheLightThatTheyReceive) {
  constexpr double low = 3.9, high = 4.1, top = 1.0, edge = 0.8;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 8}, {8, 0, 8}, {8, 0, 0}}, diffuse(0.5));
  add_polygon(scene, "lamp",
              {{low, top, low}, {high, top, low}, {high, top, high}, {low, top, high}},
              diffuse(0.0, 1.0));
  const std::vector<Point3> corners{
      {low, top, low}, {high, top, low}, {high, top, high}, {low, top, high}};
  const Vec3 down(0.0, edge - top, 0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const Point3 &a = corners[k], &b = corners[(k + 1) % 4];
    add_polygon(scene, "shade", {a, a + down, b + down, b}, diffuse(0.0));
  }
  const auto l = lit(scene, {.element_size = 1.0 / 16.0});
  const DirectIrradiance nodes = by_nodes(*l), alone = direct_irradiance(*l->light, {}, {});
  const std::vector<std::size_t> shade = elements_of(*l, "shade");
  EXPECT_GE(shade.size(), 4 * 9);
  for (const std::size_t e : shade)
    EXPECT_EQ(nodes.shared[e], 0) << "corners do not tell";
  const double received = mean_over(*l, nodes.irradiance, "shade").g;
  EXPECT_GT(received, 0.1) << "the shade faces the lamp";
  EXPECT_NEAR(received / mean_over(*l, alone.irradiance, "shade").g, 1.0, 0.03);
}

// Nodes have as many points in all, to a factor of 2, and points their rays, whatever the elements.
TEST(NodeLight, FinerElementsTakeNoMoreShadowRays) {
  std::vector<double> rays;
  for (const double elements : {64.0, 128.0, 256.0}) {
    const auto l = lit(plates_with_one_between(), {.element_size = 1.0 / elements});
    rays.push_back(double(by_nodes(*l).shadow_rays));
  }
  const auto [fewest, most] = std::ranges::minmax(rays);
  EXPECT_LT(most, 2.0 * fewest);
}

// What stands on a floor has its own elements there:
// what is open of them is as bright as it is by itself, and what is covered is dark.
TEST(NodeLight, ElementsThatAreCoveredInPartAreByThemselves) {
  const auto l = lit(plates(), {.element_size = 1.0 / 128.0});
  const NodeTree tree = make_node_tree(l->mesh, l->surfaces);
  std::vector<CoveredCells> covered(element_count(l->mesh), 0);
  std::vector<std::size_t> in_part, whole;
  for (std::size_t e = 0; e < covered.size(); e += 1000) {
    covered[e] = 0x0f0f0f0f0f0f0f0f;
    in_part.push_back(e);
    covered[e + 1] = ~CoveredCells{0};
    whole.push_back(e + 1);
  }
  const DirectSettings settings;
  const DirectIrradiance nodes = light_by_nodes(*l->light, tree, covered, settings, {}),
                         alone = direct_irradiance(*l->light, covered, settings);
  double most = 0.0;
  for (const std::size_t e : in_part) {
    EXPECT_EQ(nodes.irradiance[e].g, alone.irradiance[e].g) << "all of their points";
    most = std::max(most, nodes.irradiance[e].g);
  }
  EXPECT_GT(most, 0.1);
  for (const std::size_t e : whole)
    EXPECT_EQ(nodes.irradiance[e].g, 0.0);
}

// What is found to stand on an element later lights it anew, and those it was lit together with:
// each by itself, with all points. Others keep what they have.
TEST(NodeLight, WhatChangesIsLitAgain) {
  const auto l = lit(plates(), {.element_size = 1.0 / 128.0});
  const std::size_t size = element_count(l->mesh);
  const NodeTree tree = make_node_tree(l->mesh, l->surfaces);
  std::vector<CoveredCells> covered(size, 0);
  const DirectSettings settings;
  const DirectIrradiance before = light_by_nodes(*l->light, tree, covered, settings, {});
  const std::size_t changed = elements_of(*l, "ceiling")[1000];
  covered[changed] = 0x0f0f0f0f0f0f0f0f;
  const std::vector<ElementId> again = lit_with(tree, std::vector{static_cast<ElementId>(changed)});
  ASSERT_NE(std::ranges::find(again, static_cast<ElementId>(changed)), again.end());
  EXPECT_GT(again.size(), 1U);
  EXPECT_LE(again.size(), most_lit_together(size));

  DirectIrradiance now = before;
  light_again(*l->light, again, covered, settings, {}, now);
  const DirectIrradiance alone = direct_irradiance(*l->light, covered, settings);
  EXPECT_GT(now.shadow_rays, before.shadow_rays);
  for (std::size_t e = 0; e < size; ++e) {
    const bool is_again = std::ranges::find(again, static_cast<ElementId>(e)) != again.end();
    EXPECT_EQ(now.irradiance[e].g, (is_again ? alone : before).irradiance[e].g) << e;
    EXPECT_EQ(now.shared[e], is_again ? 0 : before.shared[e]) << e;
  }
}

// Rows share the rays of 128 as long as light is even. Its noise is sqrt(unevenness) N^-3/4,
// so that sixteen times as uneven it takes 16^(2/3) = 6.3 times as many, and never more than asked.
TEST(NodeLight, RowsShareRaysAsLightAllows) {
  FormFactorSettings settings;
  settings.rays = 512;
  const auto rays = [&](std::size_t rows, double unevenness) {
    return rays_shared_out(settings, rows, unevenness).rays;
  };
  EXPECT_EQ(rays(100, 1.0), 512);
  EXPECT_EQ(rays(1024, 1.0), 64);
  EXPECT_EQ(rays(1024, 2.0), 64);
  EXPECT_EQ(rays(1024, 32.0), 512) << "403.2, as a power of two";
  EXPECT_EQ(rays(1024, 1e6), 512);
  EXPECT_EQ(rays(100'000, 1.0), 32);
}

} // namespace
} // namespace meninas::test
