#include "radiosity/mesh/element_sizes.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/radiosity/meshed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;

TEST(ElementSizes, AreTheSameWhereNoSurfaceHasThreeQuarters) {
  const ElementSizes sizes = share_elements({3.0, 0.5, 0.5}, 400.0);
  EXPECT_NEAR(sizes.element_size, 0.1, 1e-12);
  EXPECT_THAT(sizes.of_surface, Each(DoubleNear(0.1, 1e-12)));
}

TEST(ElementSizes, ALargeGroundTakesThreeQuartersOfTheElements) {
  const ElementSizes sizes = share_elements({40.0, 360'000.0, 60.0}, 4000.0);
  EXPECT_NEAR(100.0 / std::pow(sizes.element_size, 2.0), 1000.0, 1e-9);
  EXPECT_NEAR(360'000.0 / std::pow(sizes.of_surface[1], 2.0), 3000.0, 1e-9);
  EXPECT_EQ(sizes.of_surface[0], sizes.element_size);
  EXPECT_EQ(sizes.of_surface[2], sizes.element_size);
}

TEST(ElementSizes, WhatIsVerySmallBesideAGroundGetsAFewElements) {
  const ElementSizes sizes = share_elements({1.0, 1e-12}, 100.0);
  EXPECT_NEAR(sizes.of_surface[1], 0.1 / 256.0, 1e-12);
  EXPECT_NEAR(1.0 / std::pow(sizes.of_surface[0], 2.0), 75.0, 1e-9);
}

TEST(ElementSizes, OneSurfaceHasThemAll) {
  EXPECT_NEAR(share_elements({4.0, 0.0}, 400.0).of_surface[0], 0.1, 1e-12);
  EXPECT_EQ(share_elements({0.0}, 400.0).element_size, 0.0);
  EXPECT_EQ(share_elements({}, 400.0).element_size, 0.0);
}

/// A closed unit cube on the middle of a ground of 100 m.
Scene cube_on_ground() {
  Scene scene;
  add_polygon(scene, "ground", {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}},
              diffuse(0.5));
  add_box(scene, "cube", Point3(0.0, 0.01, 0.0), Point3(1.0, 1.01, 1.0), diffuse(0.5));
  return scene;
}

// A quarter of 2,000 elements for the cube, three quarters for the ground; cells are never larger
// than asked for, which rounds the number along an edge of n up by one at most.
TEST(ElementSizes, AreThoseOfTheMesh) {
  const Meshed m = meshed(cube_on_ground(), {.target_elements = 2000});
  std::size_t on_ground = 0, on_cube = 0;
  for (std::size_t e = 0; e < element_count(m.mesh); ++e) {
    const MeshSide& side = m.mesh.sides[index(m.mesh.side_of_element[e])];
    const bool ground = m.scene.nodes[index(side.node)].name == "ground";
    ++(ground ? on_ground : on_cube);
    // Of the whole leaf: the cube hovers so low that it cuts the ground.
    const double edge = std::sqrt(cell_of(m.mesh, ElementId(e)).area), wanted = size_of(m.mesh, ElementId(e));
    EXPECT_LE(edge, wanted * (1.0 + 1e-6));
    EXPECT_GE(edge, 0.9 * wanted);
  }
  EXPECT_GE(on_ground, 1500U);
  EXPECT_LE(on_ground, 1600U);
  EXPECT_GE(on_cube, 500U);
  EXPECT_LE(on_cube, 600U);
}

} // namespace
} // namespace meninas::test
