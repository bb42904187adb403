// Names of groups: a node without a mesh stands for what is below it.
#include "scenes/gltf/tree.h"
#include "tests/scenes/gltf/gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace meninas::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Sofa (seat (cushion), empty, legs (leg, leg)) and a wall; all meshes are one square.
GltfFile sofa() {
  GltfFile file = square();
  file.json["nodes"] = Json::array({{{"name", "Sofa"}, {"children", {1, 3, 4}}},
                                    {{"name", "seat"}, {"mesh", 0}, {"children", {2}}},
                                    {{"name", "cushion"}, {"mesh", 0}},
                                    {{"name", "empty"}},
                                    {{"name", "legs"}, {"children", {5, 6}}},
                                    {{"name", "leg"}, {"mesh", 0}},
                                    {{"name", "leg"}, {"mesh", 0}},
                                    {{"name", "wall"}, {"mesh", 0}}});
  file.json["scenes"] = Json::array({{{"nodes", {7, 0}}}});
  file.json["scene"] = 0;
  return file;
}

class NodeTree : public ::testing::Test {
protected:
  std::vector<std::string> called(const std::string& name) {
    std::vector<std::string> names;
    const NamedNodes named = nodes_called(scene_, tree_, name);
    below_ = named.below;
    for (const NodeId node : named.nodes)
      names.push_back(scene_.nodes[index(node)].name);
    return names;
  }
  std::string refusal(const std::string& name) {
    try {
      nodes_called(scene_, tree_, name);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.write("sofa.gltf", as_text(sofa()));
  Scene scene_ = load_gltf(file_);
  std::vector<FileNode> tree_ = read_node_tree(file_);
  std::size_t below_ = 0;
};

TEST_F(NodeTree, AGroupIsAllThatIsBelowIt) {
  EXPECT_THAT(called("Sofa"), ElementsAre("seat", "cushion", "leg", "leg.1"));
  EXPECT_THAT(called("legs"), ElementsAre("leg", "leg.1"));
}

TEST_F(NodeTree, ANodeWithAMeshIsThatMeshAlone) {
  EXPECT_THAT(called("seat"), ElementsAre("seat"));
  EXPECT_EQ(below_, 1U);
  EXPECT_THAT(called("leg"), ElementsAre("leg"));
  EXPECT_EQ(below_, 0U);
}

TEST_F(NodeTree, NamesThatStandForNothingAreRefused) {
  EXPECT_THAT(refusal("empty"), HasSubstr("node 'empty' has no mesh, nor has any below it"));
  EXPECT_THAT(refusal("sofa"), HasSubstr("no node 'sofa', did you mean 'Sofa'?"));
  EXPECT_THAT(refusal("chandelier"), HasSubstr("no node 'chandelier' among 7 nodes such as 'wall'"));
}

} // namespace
} // namespace meninas::test
