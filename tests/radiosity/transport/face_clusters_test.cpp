// Clusters of the faces of finely tessellated curves: what they hold, and that they turn with the scene.
#include "radiosity/transport/face_clusters.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/scenes/soup.h"
#include "tests/support/globes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meninas::test {
namespace {

Scene room_with_ball(int rings) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(0.5));
  add_room(scene, {0, 0, 0}, {4, 2.6, 4}, walls);
  add_globe(scene, "ball", {{2.0, 1.6, 2.0}, 0.15, 2 * rings, rings}, diffuse(0.5));
  return scene;
}

TEST(FaceClusters, HoldFacesOnceWithinTheirBounds) {
  const auto l = lit(room_with_ball(50), {.element_size = 0.5});
  const FaceClusters clusters = face_clusters(*l->light);
  const double min_cosine = std::cos(25.0 * std::numbers::pi / 180.0), max_area = 0.125 * 0.125;
  std::vector<int> taken(l->mesh.sides.size(), 0);
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const auto sides = clusters.of(c);
    EXPECT_GE(sides.size(), 2U);
    EXPECT_LE(sides.size(), 32U);
    double area = 0.0;
    for (const SideId id : sides) {
      const MeshSide& side = l->mesh.sides[index(id)];
      EXPECT_GE(glm::dot(side.normal, l->mesh.sides[index(sides[0])].normal), min_cosine);
      area += l->mesh.area[side.first_element];
      ++taken[index(id)];
    }
    EXPECT_LE(area, max_area);
  }
  EXPECT_LE(*std::ranges::max_element(taken), 1);
  // Nearly all 5,000 faces have a neighbour that is still free when a cluster grows there.
  const auto all = std::accumulate(taken.begin(), taken.end(), std::size_t{0});
  EXPECT_GT(all, 4900U);
  EXPECT_LT(clusters.size(), all / 8);
}

// Corners and faces are told apart by their numbers and by scale-free comparisons alone.
TEST(FaceClusters, AreTheSameHoweverTheSceneLies) {
  const Scene scene = room_with_ball(50);
  const auto here = lit(scene, {.element_size = 0.5});
  const Scene there = transformed(scene, oblique_rotation(), 7.0, {30.0, -20.0, 10.0});
  const auto turned = lit(there, {.element_size = 3.5});
  const FaceClusters a = face_clusters(*here->light),
                     b = face_clusters(*turned->light);
  EXPECT_EQ(a.begin, b.begin);
  EXPECT_EQ(a.sides, b.sides);
}

TEST(FaceClusters, AreNoneWhereFewFacesAreSmall) {
  const auto l = lit(room_with_ball(24), {.element_size = 0.5});
  EXPECT_EQ(face_clusters(*l->light).size(), 0U);
}

} // namespace
} // namespace meninas::test
