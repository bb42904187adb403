// Facets of one curve share the vertices at which they meet; facets that meet in creases do not.
#include "radiosity/field/view/curve_places.h"
#include "radiosity/field/view/view_receivers.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/globes.h"

#include <gtest/gtest.h>

#include <set>

namespace meninas::test {
namespace {

constexpr Globe globe{.centre = {1.0, 1.0, 1.0}, .radius = 0.2, .meridians = 24, .parallels = 12};

/// A globe in a room, and the cells of its facets.
struct RoomWithGlobe {
  std::unique_ptr<LitScene> lit;
  LatticeCells cells;

  explicit RoomWithGlobe(GivenNormals normals)
      : lit(test::lit(scene(normals), {.element_size = 1.0})), cells(lit->mesh, elements_of_globe()) {}

  static Scene scene(GivenNormals normals) {
    Scene scene;
    std::array<Material, 6> walls;
    walls.fill(diffuse(0.5));
    add_room(scene, {0, 0, 0}, {2, 2, 2}, walls);
    add_globe(scene, "globe", globe, diffuse(0.5), normals);
    return scene;
  }
  std::vector<ElementId> elements_of_globe() const {
    std::vector<ElementId> elements;
    for (const std::size_t e : elements_of(*lit, "globe"))
      elements.push_back(static_cast<ElementId>(e));
    return elements;
  }

  /// How many vertices on borders are lit themselves; the others are where the vertex is whose light they have.
  std::size_t lit_themselves() const {
    CurvePlaces places(*lit->light, cells);
    places.find_new();
    std::set<std::uint32_t> firsts;
    for (std::uint32_t v = 0; v < cells.vertices().size(); ++v) {
      if (!cells.is_at_border(cells.vertices()[v]))
        continue;
      const std::uint32_t first = places.first_of(v);
      firsts.insert(first);
      EXPECT_LE(first, v);
      EXPECT_EQ(places.first_of(first), first);
      EXPECT_LT(glm::distance(place_of(*lit->light, cells, cells.vertices()[v]),
                              place_of(*lit->light, cells, cells.vertices()[first])),
                1e-9);
    }
    return firsts.size();
  }
};

// 11 circles of 24 vertices and the poles; and once every facet is divided the middles of 12 x 24 edges between
// circles and of 11 x 24 along them.
TEST(CurvePlaces, AreOneWhereFacetsOfACurveMeet) {
  RoomWithGlobe room(GivenNormals::smooth);
  constexpr std::size_t corners = 11 * 24 + 2, edges = 12 * 24 + 11 * 24;
  EXPECT_EQ(room.lit_themselves(), corners);
  for (std::uint32_t c = 0, roots = static_cast<std::uint32_t>(room.cells.cells().size()); c < roots; ++c)
    room.cells.divide(c);
  EXPECT_EQ(room.lit_themselves(), corners + edges);
}

TEST(CurvePlaces, AreApartWhereFacetsMeetInCreases) {
  const RoomWithGlobe room(GivenNormals::flat);
  EXPECT_EQ(room.lit_themselves(), room.cells.vertices().size());
  EXPECT_GT(room.cells.vertices().size(), 1000U);
}

// What is divided later has the light that a neighbour's vertex has had there before.
TEST(CurvePlaces, GoOnFromRoundToRound) {
  RoomWithGlobe room(GivenNormals::smooth);
  CurvePlaces places(*room.lit->light, room.cells);
  places.find_new();
  const auto count = static_cast<std::uint32_t>(room.cells.cells().size());
  for (std::uint32_t c = 0; c < count; c += 2)
    room.cells.divide(c);
  places.find_new();
  const std::size_t before = room.cells.vertices().size();
  for (std::uint32_t c = 1; c < count; c += 2)
    room.cells.divide(c);
  places.find_new();
  std::size_t shared = 0;
  for (std::size_t v = before; v < room.cells.vertices().size(); ++v)
    shared += places.first_of(v) < before;
  EXPECT_GT(shared, 100U);
}

} // namespace
} // namespace meninas::test
