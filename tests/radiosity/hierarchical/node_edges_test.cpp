// Light in the middle of edges between nodes:
// parabolas are followed, and what bends edges divides nodes.
#include "radiosity/hierarchical/node_bends.h"
#include "radiosity/hierarchical/node_edges.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

/// A floor of 2 x 2 m whose nodes of 15 x 15 elements are not halved in the middle.
std::unique_ptr<LitScene> lit_floor(double element_size) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}}, diffuse(0.5));
  return lit(scene, {.element_size = element_size});
}

/// The parts of nodes, as often;
/// of the first of those nodes its parts once more, if that is asked for.
std::vector<TreeNodeId> cut_below(const NodeTree& tree, int levels, bool uneven) {
  std::vector<TreeNodeId> nodes{static_cast<TreeNodeId>(0)};
  const auto parts = [&](std::span<const TreeNodeId> of) {
    std::vector<TreeNodeId> all;
    for (const TreeNodeId id : of)
      for (std::uint32_t c = 0; c < tree.nodes[index(id)].child_count; ++c)
        all.push_back(static_cast<TreeNodeId>(index(tree.nodes[index(id)].first_child) + c));
    return all;
  };
  for (int k = 0; k < levels; ++k)
    nodes = parts(nodes);
  if (uneven) {
    const std::vector<TreeNodeId> smaller = parts(std::span(nodes).first(1));
    nodes.erase(nodes.begin());
    nodes.insert(nodes.end(), smaller.begin(), smaller.end());
  }
  return nodes;
}

/// By ElementVertexId, 1 where a vertex gathers.
std::vector<std::uint8_t> gathering(const InterpolationWeights& shares) {
  std::vector<std::uint8_t> marks;
  for (std::size_t v = 0; v < shares.from.size(); ++v)
    marks.push_back(gathers(shares, v) ? 1 : 0);
  return marks;
}

/// Light that is quadratic over the floor, without ever being negative.
glm::vec3 parabola(const Point3& at) {
  return glm::vec3(
      Vec3(9.0 + at.x - 2.0 * at.z + 0.7 * at.x * at.x - 0.4 * at.x * at.z + at.z * at.z,
           9.0 - at.x * at.x - at.z * at.z, 9.0 + at.x * at.x - at.z * at.z));
}

std::vector<glm::vec3> parabolas(const ElementMesh& mesh) {
  std::vector<glm::vec3> light;
  for (const Point3& at : mesh.vertices)
    light.push_back(parabola(at));
  return light;
}

// Both unknowns of a parabola are determined, however nodes are halved: vertices between corners
// have its value, to the floats it is kept in, as those without a node of the same size beside
// take the bend of the edge opposite. On the line between their ends they are 0.01 to 0.1 off.
TEST(NodeEdges, FollowParabolas) {
  const auto l = lit_floor(0.14);
  const NodeTree tree = make_node_tree(*l->light);
  const std::vector<glm::vec3> light = parabolas(l->mesh);
  for (const bool uneven : {false, true}) {
    const std::vector<TreeNodeId> nodes = cut_below(tree, 2, uneven);
    const InterpolationWeights shares = vertex_shares(l->mesh, tree, nodes);
    const std::vector<glm::vec3> bends =
        edge_bends(crosses_of(l->mesh, tree, nodes), gathering(shares), light);
    float min_bend = 1.0F;
    int between = 0;
    for (std::size_t v = 0; v < light.size(); ++v) {
      if (shares.between[v] == 0) {
        EXPECT_EQ(bends[v], glm::vec3(0.0F)) << v;
        continue;
      }
      glm::vec3 linear(0.0F);
      for (std::size_t c = 0; c < 4; ++c)
        linear += shares.weight[v][c] * light[index(shares.from[v][c])];
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(linear[c] + bends[v][c], light[v][c], 2e-5F) << v;
      min_bend = std::min(min_bend, glm::length(bends[v]));
      ++between;
    }
    EXPECT_GT(between, 20);
    EXPECT_GT(min_bend, 0.01F);
  }
}

// Where the middle of a node or one of its corners has no light of its own,
// its edges stay straight; others do not change.
TEST(NodeEdges, StayStraightWhereLightIsNotKnown) {
  const auto l = lit_floor(0.14);
  const NodeTree tree = make_node_tree(*l->light);
  const std::vector<TreeNodeId> nodes = cut_below(tree, 2, false);
  const std::vector<MidpointStencil> crosses = crosses_of(l->mesh, tree, nodes);
  std::vector<glm::vec3> light = parabolas(l->mesh);
  std::vector<std::uint8_t> valid = gathering(vertex_shares(l->mesh, tree, nodes));
  const std::vector<glm::vec3> all = edge_bends(crosses, valid, light);
  valid[index(crosses[0].middle)] = 0;
  light[index(crosses[0].middle)] = glm::vec3(1e6F);
  const std::vector<glm::vec3> some = edge_bends(crosses, valid, light);
  std::size_t straight = 0;
  for (std::size_t v = 0; v < all.size(); ++v) {
    EXPECT_LT(glm::length(some[v]), 1.0F) << v;
    straight += all[v] != glm::vec3(0.0F) && some[v] == glm::vec3(0.0F) ? 1 : 0;
  }
  EXPECT_GE(straight, 2U);
  EXPECT_LE(straight, 4U);
}

// Light that is hollow along nodes and full across them, c (x^2 - z^2),
// is in their middle the mean of the corners: nodes of half a metre would not be divided. In
// the middle of edges it is c / 16 off, and that, by the same measure as of middles, divides them.
TEST(NodeEdges, SaddlesDivideNodes) {
  constexpr double c = 4.0, rho = 0.5;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(rho));
  const auto l = lit(scene, {.element_size = 1.0 / 16.0});
  const NodeTree tree = make_node_tree(*l->light);
  std::vector<glm::vec3> saddle;
  for (const Point3& at : l->mesh.vertices)
    saddle.emplace_back(float(8.0 + c * (at.x * at.x - at.z * at.z)));
  const std::vector<glm::vec3> level(saddle.size(), glm::vec3(8.0F));
  const std::vector<std::uint8_t> valid =
      gathering(vertex_shares(l->mesh, tree, cut_below(tree, 1, false)));
  const auto divided = [&](double x) {
    const BendBound bound{{1.0 / 4.0, rho}, x};
    std::vector<TreeNodeId> straight;
    EXPECT_TRUE(parts_of_bent(l->mesh, tree, cut_below(tree, 1, false), {valid, level, saddle},
                              bound, straight)
                    .empty());
    const std::size_t parts =
        parts_at_bent_edges(l->mesh, tree, {valid, level, saddle}, bound, straight).size();
    EXPECT_EQ(straight.size() + parts / 4, 4U);
    return parts;
  };
  const double bound = rho * c / 16.0 / 2.0 / (rho * 8.0 + rho / 20.0);
  EXPECT_EQ(divided(0.99 * bound), 16U);
  EXPECT_EQ(divided(1.01 * bound), 0U);
}

} // namespace
} // namespace meninas::test
