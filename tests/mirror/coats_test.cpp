// Coats as mirrors, and their worlds.
#include "mirror/worlds.h"
#include "scenes/materials/smooth_surfaces.h"
#include "tests/support/coats.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

MirrorSet mirrors_of(const Scene& scene) { return find_mirrors(scene, find_surfaces(scene)); }

TEST(Coats, OfOnePlaneAreOneMirror) {
  // Of sixty tiles of a material each none covers half a percent.
  Scene scene;
  for (int k = 0; k < 60; ++k)
    add_polygon(scene, "tile", {{k, 0, 1}, {k + 1, 0, 1}, {k + 1, 0, 0}, {k, 0, 0}},
                coated(Rgb(0.01 * k), 0.0));
  add_polygon(scene, "wall", {{0, 0, 0}, {60, 0, 0}, {60, 3, 0}, {0, 3, 0}}, diffuse(0.5));
  mark_smooth_surfaces(scene);
  for (std::size_t k = 0; k < 60; ++k)
    EXPECT_TRUE(has_mirror_coat(scene.materials[k])) << k;
  EXPECT_EQ(mirrors_of(scene).mirrors.size(), 1U);
  // Those that reflect otherwise are another.
  for (std::size_t k = 0; k < 10; ++k)
    scene.materials[k].ior = 2.0;
  EXPECT_EQ(mirrors_of(scene).mirrors.size(), 2U);
}

TEST(Coats, TakeNoMirrorsWorlds) {
  // Two mirrors that face each other between polished boards.
  Scene matt;
  add_room(matt, {0, 0, 0}, {1, 1, 1},
           {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), mirror(0.95), mirror(0.95)});
  Scene shining = matt;
  for (std::size_t k = 0; k < 4; ++k)
    shining.materials[k] = coated(Rgb(0.5), 0.0);
  mark_smooth_surfaces(shining);
  const WorldTree few = mirror_worlds(mirrors_of(matt)), many = mirror_worlds(mirrors_of(shining));
  EXPECT_EQ(few.worlds.size(), 17U);
  EXPECT_EQ(many.worlds.size(), 17U + static_cast<std::size_t>(WorldSettings{}.max_coat_worlds));
  for (std::size_t w = 0; w < few.worlds.size(); ++w)
    EXPECT_EQ(few.worlds[w].chain, many.worlds[w].chain);
}

} // namespace
} // namespace meninas::test
