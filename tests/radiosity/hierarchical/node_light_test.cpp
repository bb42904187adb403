// Direct light on elements that only light others: what their corners receive brings these,
// all together, the light that the elements do.
#include "radiosity/hierarchical/node_light.h"
#include "radiosity/hierarchical/node_solution.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

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

LitVertices lit_vertices(const LitScene& l, std::uint32_t seed = 0) {
  return lit_vertices(*l.light, {{.seed = seed}, {.seed = seed}, {}, {}});
}

/// The light on elements by their corners; nothing is covered.
DirectIrradiance by_corners(const LitScene& l, std::uint32_t seed = 0) {
  const NodeTree tree = make_node_tree(*l.light);
  return light_by_corners(*l.light, tree, std::vector<ContactMask>(element_count(l.mesh), 0),
                          lit_vertices(l, seed).found, {.seed = seed}, {});
}

std::ptrdiff_t by_themselves(const DirectIrradiance& direct) {
  return std::ranges::count(direct.shared, 0);
}

// F = 0.199824895698387383 (C-11). By the trapezoid rule the mean of h = 1/n is off by
// h^2 / 12 times the jump of F's slopes from edge to edge, 4 x 0.2 at the most.
// Half of the groups and fewer, the brightest, are lit by sixteen points for each element.
TEST(NodeLight, CornersTellWhatPlatesReceive) {
  for (const double n : {32.0, 64.0, 128.0}) {
    const auto l = lit(plates(), {.element_size = 1.0 / n});
    const DirectIrradiance direct = by_corners(*l);
    EXPECT_LT(by_themselves(direct), std::ssize(direct.shared) / 2) << n;
    EXPECT_NEAR(mean_over(*l, direct.irradiance, "ceiling").g, 0.199824895698387383,
                0.8 / 12.0 / (n * n))
        << n;
  }
}

// Meshes of a few hundred elements are lit by points of their own.
TEST(NodeLight, FewElementsAreLitByThemselves) {
  const auto l = lit(plates(), {.element_size = 1.0 / 8.0});
  const DirectIrradiance direct = by_corners(*l), alone = direct_irradiance(*l->light, {}, {});
  EXPECT_EQ(by_themselves(direct), std::ssize(direct.shared));
  EXPECT_EQ(direct.irradiance, alone.irradiance);
}

// In the penumbra, half of the ceiling, single vertices are off by less than a third of what is there,
// the mean over 500 and more of them by 0.2 x 0.33 / 23 = 3e-3.
TEST(NodeLight, PenumbraeAreNeitherDarkerNorBrighter) {
  const auto coarse = lit(plates_with_one_between(), {.element_size = 1.0 / 32.0});
  const double many =
      mean_over(
          *coarse,
          direct_irradiance(*coarse->light, {}, {.points = 64, .max_points = 1024}).irradiance,
          "ceiling")
          .g;
  EXPECT_LT(many, 0.15);
  for (const double elements : {32.0, 64.0, 128.0}) {
    const auto l = lit(plates_with_one_between(), {.element_size = 1.0 / elements});
    EXPECT_NEAR(mean_over(*l, by_corners(*l).irradiance, "ceiling").g, many, 4 * 3e-3) << elements;
  }
}

// The sun through a window of 0.33 x 0.33 m2 onto a floor of 8 x 8 m2 in elements of 1/16 m:
// 5.3 x 5.3 of 16,384, which have all of the light, E = 1. At an edge an element is found lit
// to a 64th, and the error of 22 of them is 22^1/2 / 8 / 28: 2 % of the light at the most.
// By their corners alone it is off by more: which of these are lit is chance.
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
    EXPECT_NEAR(64.0 * mean_over(*l, by_corners(*l, seed).irradiance, "floor").g, side * side,
                0.02 * side * side)
        << seed;
}

// The black shade of a lamp takes most of its light and gives none back:
// its elements, over each of which light varies by several times, have points of their own.
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
  const DirectIrradiance nodes = by_corners(*l), alone = direct_irradiance(*l->light, {}, {});
  const std::vector<std::size_t> shade = elements_of(*l, "shade");
  EXPECT_GE(shade.size(), 4 * 9);
  for (const std::size_t e : shade)
    EXPECT_EQ(nodes.shared[e], 0) << "corners do not tell";
  const double received = mean_over(*l, nodes.irradiance, "shade").g;
  EXPECT_GT(received, 0.1) << "the shade faces the lamp";
  EXPECT_NEAR(received / mean_over(*l, alone.irradiance, "shade").g, 1.0, 0.03);
}

// A ceiling of 20 x 20 lamps above a plate that hides half of the floor, of which one element is seen: its corners have
// the light they have where all are seen. Others have that of 32 lamps in place of 256, each off by a few per cent,
// and the mean over a thousand of them is off by a thousandth or so.
TEST(NodeLight, VerticesThatAreNotSeenTakeFewerImages) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5));
  add_polygon(scene, "plate", {{0, 0.1, 0}, {0.5, 0.1, 0}, {0.5, 0.1, 1}, {0, 0.1, 1}},
              double_sided(diffuse(0.0)));
  constexpr double n = 20.0, size = 0.4 / n;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) {
      const double x = i / n, z = k / n;
      add_polygon(scene, "lamp",
                  {{x, 0.2, z}, {x + size, 0.2, z}, {x + size, 0.2, z + size}, {x, 0.2, z + size}},
                  diffuse(0.0, 1.0));
    }
  const auto l = lit(scene, {.element_size = 1.0 / 32.0});
  std::vector<std::uint8_t> seen(element_count(l->mesh), 0);
  const std::size_t one = elements_of(*l, "floor")[400];
  seen[one] = 1;
  const LitVertices all = lit_vertices(*l->light, {{}, {}, {}, {}}),
                    few = lit_vertices(*l->light, {{}, {}, {}, {}, seen});
  EXPECT_LT(3 * few.shadow_rays, 2 * all.shadow_rays);
  std::size_t bright = 0, others = 0;
  for (std::size_t v = 0; v < l->mesh.vertices.size(); ++v)
    if (all.found.field.irradiance[v] != glm::vec3(0.0F)) {
      ++bright;
      others += few.found.field.irradiance[v] != all.found.field.irradiance[v] ? 1 : 0;
    }
  EXPECT_GT(2 * others, bright) << "not those beside penumbrae alone";
  for (const ElementVertexId v : l->mesh.corners[one])
    EXPECT_EQ(few.found.field.irradiance[index(v)], all.found.field.irradiance[index(v)]);
  std::vector<Rgb> of_all, of_few;
  for (std::size_t e = 0; e < seen.size(); ++e) {
    const auto mean = [&](const LitVertices& lit) {
      Rgb sum(0.0);
      for (const ElementVertexId v : l->mesh.corners[e])
        sum += 0.25 * Rgb(lit.found.field.irradiance[index(v)]);
      return sum;
    };
    of_all.push_back(mean(all));
    of_few.push_back(mean(few));
  }
  const double expected = mean_over(*l, of_all, "floor").g;
  EXPECT_GT(expected, 0.02);
  EXPECT_NEAR(mean_over(*l, of_few, "floor").g, expected, 4e-3 * expected);
}

// What vertices know costs elements nothing: only those by themselves take shadow rays.
TEST(NodeLight, CornersTakeNoShadowRays) {
  const auto l = lit(plates_with_one_between(), {.element_size = 1.0 / 64.0});
  const DirectIrradiance direct = by_corners(*l);
  std::vector<ElementId> alone;
  for (std::uint32_t e = 0; e < direct.shared.size(); ++e)
    if (direct.shared[e] == 0)
      alone.push_back(static_cast<ElementId>(e));
  DirectIrradiance again = direct;
  again.shadow_rays = 0;
  recompute_direct(*l->light, alone, std::vector<ContactMask>(direct.shared.size(), 0), {}, {}, again);
  EXPECT_EQ(direct.shadow_rays, again.shadow_rays);
  EXPECT_LT(alone.size(), direct.shared.size() / 2);
}

// Punctual lights enter where they arrive: their part is told by corners too.
TEST(NodeLight, CornersTellThePartOfPunctualLights) {
  Scene scene = plates();
  PunctualLight point;
  point.position = {0.5, 0.5, 0.5};
  point.intensity = Rgb(1.0);
  scene.lights = {point};
  const auto l = lit(scene, {.element_size = 1.0 / 32.0});
  const DirectIrradiance both = by_corners(*l);
  ASSERT_EQ(both.entering.size(), both.irradiance.size());
  scene.materials.front().emission = Rgb(0.0);
  const auto dark = lit(scene, {.element_size = 1.0 / 32.0});
  const DirectIrradiance alone = by_corners(*dark);
  for (const std::string plate : {"floor", "ceiling"}) {
    const double part = mean_over(*l, both.entering, plate).g;
    EXPECT_GT(part, 0.1);
    EXPECT_NEAR(part, mean_over(*dark, alone.irradiance, plate).g, 1e-6);
  }
}

// What stands on a floor has its own elements there:
// what is open of them is as bright as it is by itself, and what is covered is dark.
TEST(NodeLight, ElementsThatAreCoveredInPartAreByThemselves) {
  const auto l = lit(plates(), {.element_size = 1.0 / 128.0});
  const NodeTree tree = make_node_tree(*l->light);
  std::vector<ContactMask> covered(element_count(l->mesh), 0);
  std::vector<std::size_t> in_part, whole;
  for (std::size_t e = 0; e < covered.size(); e += 1000) {
    covered[e] = 0x0f0f0f0f0f0f0f0f;
    in_part.push_back(e);
    covered[e + 1] = ~ContactMask{0};
    whole.push_back(e + 1);
  }
  const DirectSettings settings;
  const DirectIrradiance nodes = light_by_corners(*l->light, tree, covered, lit_vertices(*l).found,
                                                  settings, {}),
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

// What is found to stand on an element later lights it anew. Others keep what they have.
TEST(NodeLight, WhatChangesIsLitAgain) {
  const auto l = lit(plates(), {.element_size = 1.0 / 64.0});
  std::vector<ContactMask> covered(element_count(l->mesh), 0);
  const DirectSettings settings;
  const DirectIrradiance before = by_corners(*l);
  const std::vector<std::size_t> ceiling = elements_of(*l, "ceiling");
  const std::size_t changed =
      *std::ranges::find_if(ceiling, [&](std::size_t e) { return before.shared[e] != 0; });
  covered[changed] = 0x0f0f0f0f0f0f0f0f;

  DirectIrradiance now = before;
  recompute_direct(*l->light, std::vector{static_cast<ElementId>(changed)}, covered, settings, {}, now);
  const DirectIrradiance alone = direct_irradiance(*l->light, covered, settings);
  EXPECT_GT(now.shadow_rays, before.shadow_rays);
  for (std::size_t e = 0; e < covered.size(); ++e) {
    EXPECT_EQ(now.irradiance[e].g, (e == changed ? alone : before).irradiance[e].g) << e;
    EXPECT_EQ(now.shared[e], e == changed ? 0 : before.shared[e]) << e;
  }
}

// Rows share the rays of 512 as long as light is even. Its noise is sqrt(unevenness) N^-3/4,
// so that four times as uneven it takes 4^(2/3) = 2.5 times as many, and never more than asked.
TEST(NodeLight, RowsShareRaysAsLightAllows) {
  FormFactorSettings settings;
  settings.rays = 512;
  const auto rays = [&](std::size_t rows, double unevenness) {
    return rays_per_row(settings, rows, unevenness).rays;
  };
  EXPECT_EQ(rays(500, 1.0), 512);
  EXPECT_EQ(rays(4096, 1.0), 64);
  EXPECT_EQ(rays(4096, 2.0), 64);
  EXPECT_EQ(rays(4096, 8.0), 256) << "161.3, as a power of two";
  EXPECT_EQ(rays(4096, 1e6), 512);
  EXPECT_EQ(rays(100'000, 1.0), 32);
}

} // namespace
} // namespace meninas::test
