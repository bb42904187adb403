// Nodes and vertices: which gather, what the others take from them,
// and where light is too bent for a node to stand for what is between its corners.
#include "radiosity/hierarchical/node_bends.h"
#include "radiosity/hierarchical/node_cut.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meninas::test {
namespace {

std::vector<TreeNodeId> parts_of(const NodeTree& tree, TreeNodeId id) {
  std::vector<TreeNodeId> parts;
  for (std::uint32_t c = 0; c < tree.nodes[index(id)].child_count; ++c)
    parts.push_back(static_cast<TreeNodeId>(index(tree.nodes[index(id)].first_child) + c));
  return parts;
}

/// A cut through the tree that is uneven: of every third of the first receivers, the parts.
std::vector<TreeNodeId> uneven_cut(const ElementMesh& mesh, const NodeTree& tree) {
  std::vector<TreeNodeId> nodes;
  for (const TreeNodeId id : first_receivers(mesh, tree)) {
    if (index(id) % 3 != 0 || is_leaf(tree.nodes[index(id)]))
      nodes.push_back(id);
    else
      std::ranges::copy(parts_of(tree, id), std::back_inserter(nodes));
  }
  return nodes;
}

std::vector<Scene> rooms_and_figures() {
  return {half_room(), load_gltf(source_dir() + "/scenes/gallery/meninas.gltf")};
}

// Where a vertex is is linear over its patch: interpolated, positions are what they are,
// to the floats that weights are kept in. Weights are those of means.
TEST(NodeVertices, SharesOfPositionsArePositions) {
  for (const Scene& scene : rooms_and_figures()) {
    const auto l = lit(scene, {.element_size = 0.15});
    const NodeTree tree = make_node_tree(*l->light);
    const std::vector<TreeNodeId> nodes = uneven_cut(l->mesh, tree);
    const InterpolationWeights shares = vertex_shares(l->mesh, tree, nodes);
    std::size_t gathering = 0;
    for (std::size_t v = 0; v < l->mesh.vertices.size(); ++v) {
      Point3 interpolated(0.0);
      double sum = 0.0;
      for (std::size_t c = 0; c < 4; ++c) {
        const double weight = double{shares.weight[v][c]};
        EXPECT_GE(weight, -1e-6) << v;
        interpolated += weight * l->mesh.vertices[index(shares.from[v][c])];
        sum += weight;
      }
      EXPECT_NEAR(sum, 1.0, 1e-6) << v;
      EXPECT_LT(glm::distance(interpolated, l->mesh.vertices[v]), 1e-5) << v;
      gathering += gathers(shares, v) ? 1 : 0;
    }
    EXPECT_LT(gathering, l->mesh.vertices.size());
  }
}

// Those that others take from gather, or lie between those that do.
TEST(NodeVertices, SharesEndAtVerticesThatGather) {
  for (const Scene& scene : rooms_and_figures()) {
    const auto l = lit(scene, {.element_size = 0.15});
    const NodeTree tree = make_node_tree(*l->light);
    const InterpolationWeights shares = vertex_shares(l->mesh, tree, uneven_cut(l->mesh, tree));
    const auto takes_from_others = [&](std::size_t v) {
      return !gathers(shares, v) && shares.between[v] == 0;
    };
    for (std::size_t v = 0; v < l->mesh.vertices.size(); ++v)
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t from = index(shares.from[v][c]);
        EXPECT_FALSE(!gathers(shares, v) && takes_from_others(from)) << v;
        EXPECT_TRUE(shares.between[v] == 0 || gathers(shares, from)) << v;
      }
  }
}

// Of a square metre divided into four, one of which is divided again: at (1, 1) / 2 meet parts of
// 1/4 and of 1/16, and it stands for the larger. What only parts of 1/16 have stands for as much.
TEST(NodeVertices, VerticesStandForTheLargestNodeThatWantsThem) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5));
  const auto l = lit(scene, {.element_size = 1.0 / 8.0});
  const NodeTree tree = make_node_tree(*l->light);
  std::vector<TreeNodeId> nodes = parts_of(tree, static_cast<TreeNodeId>(0));
  ASSERT_EQ(nodes.size(), 4U);
  const std::vector<TreeNodeId> smaller = parts_of(tree, nodes.front());
  nodes.erase(nodes.begin());
  nodes.insert(nodes.end(), smaller.begin(), smaller.end());
  const std::vector<double> wanted = wanted_vertices(l->mesh, tree, nodes);
  const TreeNode& divided = tree.nodes[index(smaller.front())];
  // Places in the divided part, in quarters of it from its corner at the edge of the floor.
  const auto at = [&](double s, double t) {
    const Vec2 corner = glm::round(divided.uv); // of the floor
    const Vec2 uv = glm::abs(corner - 0.125 * Vec2(s, t));
    for (std::size_t v = 0; v < wanted.size(); ++v)
      if (glm::distance(l->mesh.vertices[v],
                        point_at(l->surfaces.patches[index(l->mesh.sides[0].patch)], uv)) < 1e-9)
        return wanted[v];
    return -1.0;
  };
  EXPECT_DOUBLE_EQ(at(4, 4), 1.0 / 4.0);
  EXPECT_DOUBLE_EQ(at(2, 2), 1.0 / 16.0);
  EXPECT_DOUBLE_EQ(at(1, 1), 1.0 / 16.0); // a middle
  EXPECT_DOUBLE_EQ(at(1, 2), 0.0);
}

// A parabola of height h over a node is h off its corners' mean in the middle, a slope is
// not off at all: the node gives way above X = rho h / 2 (rho H + B_mean / 20), also in the dark.
TEST(NodeVertices, NodesGiveWayToBendsOnly) {
  constexpr double height = 0.2, rho = 0.5;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(rho));
  const auto l = lit(scene, {.element_size = 1.0 / 8.0});
  const NodeTree tree = make_node_tree(*l->light);
  const std::vector top{static_cast<TreeNodeId>(0)};
  const auto parts = [&](double level, double bow, double slope, double x) {
    std::vector<glm::vec3> light;
    for (const Point3& at : l->mesh.vertices)
      light.emplace_back(float(level + slope * at.x + bow * 4.0 * at.x * (1.0 - at.x)));
    const std::vector<std::uint8_t> valid(light.size(), 1);
    std::vector<TreeNodeId> straight;
    const std::size_t bent =
        parts_of_bent(l->mesh, tree, top, {valid, light, light}, {{1.0, rho}, x}, straight).size();
    EXPECT_EQ(straight.empty(), bent > 0);
    return bent;
  };
  for (const double level : {1.0, 0.02}) {
    const double bow = height * level, bound = 0.5 * bow / (level + bow + 0.05);
    EXPECT_EQ(parts(level, bow, 0.0, 0.99 * bound), 4U);
    EXPECT_EQ(parts(level, bow, 0.0, 1.01 * bound), 0U);
    EXPECT_EQ(parts(level, 0.0, 5.0, 1e-4), 0U);
  }
}

// A node twice as long as wide has two parts, which meet on its short axis. Light that bends from
// one long edge to the other shows on neither: it does in the middle, whose vertex keeps no value.
TEST(NodeVertices, NodesOfTwoPartsGiveWayToBendsAcrossThem) {
  constexpr double rho = 0.5;
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 0}}, diffuse(rho));
  const auto l = lit(scene, {.element_size = 1.0 / 8.0});
  const NodeTree tree = make_node_tree(*l->light);
  const std::vector top{static_cast<TreeNodeId>(0)};
  ASSERT_EQ(tree.nodes[0].child_count, 2);
  const std::vector<std::uint8_t> valid(l->mesh.vertices.size(), 1);
  const auto parts = [&](auto&& light_at) {
    std::vector<glm::vec3> light;
    for (const Point3& at : l->mesh.vertices)
      light.emplace_back(float(light_at(at)));
    std::vector<TreeNodeId> straight;
    return parts_of_bent(l->mesh, tree, top, {valid, light, light}, {{2.0, rho}, 0.02}, straight)
        .size();
  };
  EXPECT_EQ(parts([](const Point3& x) { return 1.0 + x.z * (1.0 - x.z); }), 2U);
  EXPECT_EQ(parts([](const Point3& x) { return 1.0 + x.x * (2.0 - x.x); }), 2U);
  EXPECT_EQ(parts([](const Point3& x) { return 1.0 + x.x + 3.0 * x.z; }), 0U);

  const std::vector<double> wanted = wanted_vertices(l->mesh, tree, top);
  const InterpolationWeights shares = vertex_shares(l->mesh, tree, top);
  std::size_t asked = 0, gathering = 0;
  for (std::size_t v = 0; v < wanted.size(); ++v) {
    asked += wanted[v] > 0.0 ? 1 : 0;
    gathering += gathers(shares, v) ? 1 : 0;
  }
  EXPECT_EQ(asked, 7U); // four corners, the middles of the long edges, the middle
  EXPECT_EQ(gathering, 6U);
}

// Something stands on a part of a node where some of its vertices have no light of their own:
// that part is found. Where none has, there is nothing to find.
TEST(NodeVertices, NodesGiveWayToWhatStandsOnAPartOfThem) {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, diffuse(0.5));
  const auto l = lit(scene, {.element_size = 1.0 / 8.0});
  const NodeTree tree = make_node_tree(*l->light);
  const std::vector<TreeNodeId> top{static_cast<TreeNodeId>(0)};
  const std::vector<glm::vec3> light(l->mesh.vertices.size(), glm::vec3(1.0F));
  const auto parts = [&](auto is_covered) {
    std::vector<std::uint8_t> valid;
    for (const Point3& at : l->mesh.vertices)
      valid.push_back(is_covered(at) ? 0 : 1);
    std::vector<TreeNodeId> straight;
    return parts_of_bent(l->mesh, tree, top, {valid, light, light}, {{1.0, 0.5}, 0.01}, straight)
        .size();
  };
  EXPECT_EQ(parts([](const Point3&) { return false; }), 0U);
  EXPECT_EQ(parts([](const Point3& at) { return at.x + at.z < 0.1; }), 4U);
  EXPECT_EQ(parts([](const Point3& at) { return std::abs(at.x - 0.5) < 0.1; }), 4U);
  EXPECT_EQ(parts([](const Point3& at) { return at.x < 0.9; }), 4U);
  EXPECT_EQ(parts([](const Point3&) { return true; }), 0U);
}

} // namespace
} // namespace meninas::test
