// The vertices of a page: every corner has what the room says of it, and no vertex is there twice.
#include "runs/walk/walk_vertices.h"

#include "scenes/sampling.h"
#include "tests/runs/walk/unpacked.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace meninas {
namespace {

using test::unpacked;

constexpr int side = 40; // quads

/// As uneven as light of few rays.
glm::vec3 noise(int x, int y) {
  const auto at = [&](std::uint32_t band) {
    return 1.0F + 0x1p-32F * static_cast<float>(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), band));
  };
  return {at(0), at(1), at(2)};
}

/// A floor of facets: each of its triangles has vertices of its own, with the light of their places.
/// The second half is another batch.
WalkRoom facets() {
  WalkRoom room;
  const auto add = [&](int x, int y) {
    WalkVertex vertex;
    vertex.position = glm::vec3(0.1F * static_cast<float>(x), 0.0F, 0.1F * static_cast<float>(y));
    vertex.irradiance = noise(x, y);
    room.indices.push_back(static_cast<std::uint32_t>(room.vertices.size()));
    room.vertices.push_back(vertex);
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 0), std::pair(1, 1), std::pair(0, 1)})
        add(x + i, y + j);
      room.element_ends.push_back(static_cast<std::uint32_t>(room.indices.size() / 3));
    }
  room.batches = {{.first = 0, .count = side * side}, {.node = NodeId{1}, .first = side * side, .count = side * side}};
  return room;
}

std::size_t vertices_of(const PageVertices& page) { return unpacked(page.packed, "look").size(); }

/// The rows of a table at all corners of all triangles.
std::vector<std::uint32_t> at_corners(const PageVertices& page, const char* name, std::size_t columns) {
  const auto table = unpacked(page.packed, name), triangles = unpacked(page.packed, "triangles");
  std::vector<std::uint32_t> values;
  for (const std::uint32_t v : triangles)
    for (std::size_t k = 0; k < columns; ++k)
      values.push_back(table.at(v * columns + k));
  return values;
}

/// With a normal, places on textures, and a colour, by the light of the vertex.
WalkRoom dressed_facets() {
  WalkRoom room = facets();
  for (WalkVertex& v : room.vertices) {
    v.normal = glm::normalize(v.irradiance);
    v.colour_place = v.emission_place = glm::vec2(v.irradiance);
    v.colour = glm::vec4(0.5F * v.irradiance, 1.0F);
  }
  return room;
}

TEST(WalkVertices, OfFacetsAreOneAtAPlaceOfABatch) {
  const WalkRoom room = dressed_facets();
  const PageVertices all = page_vertices(room, 0, VertexNumbering::by_room),
                     joined = page_vertices(room, 0, VertexNumbering::joined);
  EXPECT_EQ(vertices_of(all), room.vertices.size());
  EXPECT_EQ(unpacked(all.packed, "triangles"), room.indices);
  EXPECT_EQ(vertices_of(joined), (side + 1) * (side + 1) + (side + 1)) << "the row between the batches twice";
  for (const auto& [name, columns] : {std::pair("position", 3), std::pair("irradiance", 3), std::pair("normal", 2),
                                      std::pair("place", 4), std::pair("colour", 4), std::pair("look", 1)})
    EXPECT_EQ(at_corners(joined, name, static_cast<std::size_t>(columns)),
              at_corners(all, name, static_cast<std::size_t>(columns))) << name;
  EXPECT_EQ(unpacked(joined.packed, "elementEnds"), room.element_ends);
  // Six corners of a quad are a vertex and a few numbers of triangles.
  EXPECT_LT(2 * deflated(joined.packed.bytes).size(), deflated(all.packed.bytes).size());
}

// A page takes a room's vertices as white, without normals and without textures, unless it is told.
TEST(WalkVertices, LeaveOutWhatNoneHas) {
  const auto names = [](const WalkRoom& room) {
    std::vector<std::string> all;
    for (const PackedTable& table : page_vertices(room, 0, VertexNumbering::by_room).packed.tables)
      all.push_back(table.name);
    return all;
  };
  const std::vector<std::string> least{"position", "look", "irradiance", "triangles", "elementEnds"};
  const std::vector<std::string> most{"position", "normal", "place", "colour", "look", "irradiance", "triangles", "elementEnds"};
  EXPECT_EQ(names(facets()), least);
  EXPECT_EQ(names(dressed_facets()), most);
  WalkRoom room = facets();
  room.vertices.back().colour.a = 0.5F;
  EXPECT_EQ(names(room), (std::vector<std::string>{"position", "colour", "look", "irradiance", "triangles", "elementEnds"}));
}

// What differs in any way is apart: where it is, its light, that of a lamp alone, its colour.
TEST(WalkVertices, ThatDifferAreApart) {
  WalkRoom room = facets();
  const auto joined = [&](std::size_t lamps) { return vertices_of(page_vertices(room, lamps, VertexNumbering::joined)); };
  const std::size_t before = joined(0);
  room.vertices[1].colour.r = 0.5F; // of a corner that another triangle has as well
  EXPECT_EQ(joined(0), before + 1);
  room.vertices[1].colour.r = 1.0F;
  room.vertices[1].irradiance.b *= 1.01F;
  EXPECT_EQ(joined(0), before + 1);
  room = facets();
  room.irradiance_by_lamp.assign(1, std::vector<glm::vec3>(room.vertices.size(), glm::vec3(1.0F)));
  room.irradiance_by_lamp[0][1] = glm::vec3(0.9F);
  EXPECT_EQ(joined(0), before);
  EXPECT_EQ(joined(1), before + 1);
}

// Positions are off by half a step, 2^-21 of the farthest, light by half of the last of eleven bits of a half.
TEST(WalkVertices, AreAsExactAsTheirSteps) {
  const WalkRoom room = facets();
  const PageVertices page = page_vertices(room, 0, VertexNumbering::by_room);
  const double farthest = 0.1 * side;
  EXPECT_NEAR(page.step, farthest * 0x1p-20, 1e-6 * page.step); // floats
  const auto position = unpacked(page.packed, "position"), irradiance = unpacked(page.packed, "irradiance");
  for (std::size_t v = 0; v < room.vertices.size(); ++v) {
    const std::uint32_t green = irradiance[3 * v];
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = 3 * v + static_cast<std::size_t>(k);
      EXPECT_NEAR(page.step * static_cast<std::int32_t>(position[at]), double{room.vertices[v].position[k]},
                  0.5001 * page.step);
    }
    const std::array<std::uint32_t, 3> bits{green + irradiance[3 * v + 1], green, green + irradiance[3 * v + 2]};
    for (int band = 0; band < 3; ++band) {
      const double shown = double{page.light} * double{glm::unpackHalf1x16(static_cast<std::uint16_t>(bits[static_cast<std::size_t>(band)]))};
      const double light = double{room.vertices[v].irradiance[band]};
      EXPECT_NEAR(shown, light, 0x1.01p-11 * light);
    }
  }
}

} // namespace
} // namespace meninas
