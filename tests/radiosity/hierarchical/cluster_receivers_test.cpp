// Clusters of faces as receivers: their rows against closed forms, and what is solved by them against rows of all faces.
#include "form_factors/point_form_factor.h"
#include "mirror/convex_polygon.h"
#include "radiosity/field/vertex_places.h"
#include "radiosity/hierarchical/node_cut.h"
#include "tests/radiosity/solved.h"
#include "tests/support/globes.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A ball of 5,000 faces in a room whose ceiling is brighter than the rest.
Scene room_with_ball(double wall, double ceiling, double ball) {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(wall));
  walls[3] = diffuse(ceiling);
  add_room(scene, {0, 0, 0}, {4, 2.6, 4}, walls);
  add_globe(scene, "ball", {.centre = {2.0, 1.6, 2.0}, .radius = 0.15, .meridians = 100, .parallels = 50}, diffuse(ball));
  return scene;
}

// Nothing stands between a ball and the ceiling but the ball's own horizon: F of each face by Lambert's formula,
// the mean of its faces for a cluster. Rays about one normal alone would be off by up to sin 25 degrees / 2.
TEST(ClusterReceivers, RowsAreMeansOverFaces) {
  const auto l = lit(room_with_ball(0.5, 0.5, 0.5), {.element_size = 0.5});
  const NodeTree tree = make_node_tree(*l->light);
  constexpr int rays = 256;
  const NodeCut cut = first_cut(*l->light, tree, {.rays = rays}, {});
  const auto ceiling_elements = elements_of(*l, "y1");
  std::vector<std::uint8_t> is_ceiling(element_count(l->mesh), 0);
  for (const std::size_t e : ceiling_elements)
    is_ceiling[e] = 1;
  const std::array<Point3, 4> ceiling{Point3(0, 2.6, 0), {4, 2.6, 0}, {4, 2.6, 4}, {0, 2.6, 4}};
  std::size_t clusters = 0;
  double squares = 0.0, variance = 0.0;
  for (std::size_t r = 0; r < cut.receivers.size(); ++r) {
    if (!is_cluster(tree.nodes[index(cut.receivers[r])]))
      continue;
    ++clusters;
    double sampled = 0.0, all = 0.0, exact = 0.0, area = 0.0;
    for (auto k = cut.rows.row_begin[r]; k < cut.rows.row_begin[r + 1]; ++k) {
      all += double{cut.rows.weights[k]};
      sampled += is_ceiling[cut.rows.columns[k]] != 0 ? double{cut.rows.weights[k]} : 0.0;
    }
    EXPECT_NEAR(all, 1.0, 1e-5) << "a ball sees nothing but the room";
    for (const ElementId e : elements_below(tree, cut.receivers[r])) {
      const MeshSide& side = l->mesh.sides[index(l->mesh.side_of_element[index(e)])];
      const Point3 x = centre_of(l->mesh, e);
      const ConvexPolygon above = clip(ConvexPolygon(ceiling), x, side.normal);
      if (!above.empty())
        exact += l->mesh.area[index(e)] * point_form_factor(x, side.normal, above.span());
      area += l->mesh.area[index(e)];
    }
    exact /= area;
    squares += (sampled - exact) * (sampled - exact);
    variance += exact * (1.0 - exact) / (4 * rays);
  }
  ASSERT_GT(clusters, 100U);
  // Rays that are spread evenly err less than independent ones.
  EXPECT_LT(squares, variance);
}

// Light on one side of a sheet is none on the other: what parts the middles of faces parts clusters, wherever it cuts the ball,
// also where faces meet in a pole. A cluster that reached past it would mix the light of both sides.
TEST(ClusterReceivers, DoNotReachPastASheet) {
  for (const double at : {2.003, 2.01, 2.024, 2.05, 2.09}) {
    SCOPED_TRACE(at);
    Scene scene = room_with_ball(0.5, 0.5, 0.5);
    add_polygon(scene, "sheet", {{at, 1.2, 1.6}, {at, 2.0, 1.6}, {at, 2.0, 2.4}, {at, 1.2, 2.4}},
                double_sided(diffuse(0.5)));
    const auto l = lit(std::move(scene), {.element_size = 0.5});
    const NodeTree tree = make_node_tree(*l->light);
    std::size_t clusters = 0, beside = 0;
    for (const TreeNodeId id : first_receivers(l->mesh, tree)) {
      if (!is_cluster(tree.nodes[index(id)]))
        continue;
      ++clusters;
      const auto faces = elements_below(tree, id);
      const auto beyond = std::ranges::count_if(
          faces, [&](ElementId e) { return centre_of(l->mesh, e).x > at; });
      EXPECT_TRUE(beyond == 0 || beyond == std::ssize(faces)) << beyond << " of " << faces.size();
      beside += std::ranges::any_of(faces, [&](ElementId e) { return std::abs(centre_of(l->mesh, e).x - at) < 0.01; });
    }
    EXPECT_GT(clusters, 100U);
    EXPECT_GT(beside, 10U) << "faces beside the sheet are still in clusters, on their own side";
  }
}

// Everything glows and reflects so that B = 1: E = 1 - rho. Clusters of a convex body see nothing but that.
TEST(ClusterReceivers, AreExactInAFurnace) {
  Scene scene = room_with_ball(0.5, 0.5, 0.5);
  for (Material& material : scene.materials)
    material.emission = Rgb(0.5 / std::numbers::pi);
  PassOneSettings settings;
  settings.mesh.element_size = 0.5;
  settings.cut = MeshCut::hierarchical;
  settings.solver.tolerance = 1e-7;
  const auto l = lit(scene, settings.mesh);
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  EXPECT_LT(solution.links->receivers, element_count(l->mesh) / 4);
  for (const std::size_t e : elements_of(*l, "ball"))
    ASSERT_NEAR(solution.radiosity[e].g, 1.0, 0.01) << "direct light is sampled to 1 %";
}

} // namespace
} // namespace meninas::test
