// Blocks of elements that shoot together: a partition, and few of them.
#include "radiosity/solvers/shooting_blocks.h"
#include "scenes/gltf/gltf.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"
#include "tests/support/source_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

TEST(ShootingBlocks, CoverEveryElementOnce) {
  const auto l =
      lit(load_gltf(source_dir() + "/scenes/gallery/meninas.gltf"), {.target_elements = 3000});
  const Shooters blocks =
      make_shooting_blocks(l->mesh, std::vector<float>(element_count(l->mesh), 1.0F));
  std::vector<int> met(element_count(l->mesh), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    ASSERT_FALSE(blocks.members(b).empty());
    EXPECT_LE(blocks.members(b).size(), 64U);
    for (const auto e : blocks.members(b)) {
      ++met[e];
      EXPECT_EQ(blocks.of_unknown[e], b);
      EXPECT_EQ(l->mesh.side_of_element[e], l->mesh.side_of_element[blocks.members(b)[0]]);
    }
  }
  EXPECT_EQ(std::ranges::count(met, 1), std::ssize(met));
}

// A floor of 190 x 190 tiles, each a patch of one element:
// a shooter each would take longer to choose than to shoot.
TEST(ShootingBlocks, AreSharedBySmallPatches) {
  constexpr int tiles = 190;
  Scene scene;
  const Material grey = diffuse(0.5);
  for (int i = 0; i < tiles; ++i)
    for (int j = 0; j < tiles; ++j)
      add_polygon(scene, "tile", {{i, 0, j}, {i, 0, j + 1}, {i + 1, 0, j + 1}, {i + 1, 0, j}},
                  grey);
  const auto l = lit(std::move(scene), {.element_size = 2.0});
  const std::size_t size = element_count(l->mesh);
  ASSERT_EQ(size, static_cast<std::size_t>(tiles * tiles));
  const Shooters blocks = make_shooting_blocks(l->mesh, std::vector<float>(size, 1.0F));
  EXPECT_EQ(blocks.size(), size / 2);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    EXPECT_EQ(blocks.members(b).size(), 2U);
}

} // namespace
} // namespace meninas::test
