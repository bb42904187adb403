// Flat surfaces of slivers are triangulated anew within the outline they had.
#include "scenes/repair/retriangulation.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace meninas::test {
namespace {

/// A surface of one node in a scene: vertices, then triangles.
struct Sheet {
  Scene scene;

  explicit Sheet(const Material& material = diffuse(0.5)) {
    scene.materials = {material};
    scene.nodes = {{"sheet"}};
    scene.position_error = 1e-9;
  }
  VertexId vertex(const Point3& at) {
    scene.vertices.push_back({.position = at});
    return static_cast<VertexId>(scene.vertices.size() - 1);
  }
  void triangle(VertexId a, VertexId b, VertexId c) {
    scene.triangles.push_back({{a, b, c}, MaterialId{0}, NodeId{0}});
  }
};

Point3 on_circle(double radius, int k, int count, double height = 0.0) {
  const double turn = 2.0 * std::numbers::pi * k / count;
  return {radius * std::cos(turn), height, -radius * std::sin(turn)};
}

/// A disc as a fan around its middle, its front up.
Sheet fan_about_middle(int count, double radius) {
  Sheet sheet;
  const VertexId middle = sheet.vertex(Point3(0.0));
  std::vector<VertexId> rim;
  for (int k = 0; k < count; ++k)
    rim.push_back(sheet.vertex(on_circle(radius, k, count)));
  for (int k = 0; k < count; ++k)
    sheet.triangle(middle, rim[k], rim[(k + 1) % count]);
  return sheet;
}

/// A polygon as a fan about its first corner, as exporters write n-gons.
Sheet fan_about_corner(const std::vector<Point3>& corners) {
  Sheet sheet;
  std::vector<VertexId> rim;
  for (const Point3& corner : corners)
    rim.push_back(sheet.vertex(corner));
  for (std::size_t k = 1; k + 1 < rim.size(); ++k)
    sheet.triangle(rim[0], rim[k], rim[k + 1]);
  return sheet;
}

/// A floor with a round hole, cut in ears from its four corners to the hole.
Sheet floor_with_hole(int count, double radius, double half) {
  Sheet sheet;
  std::vector<VertexId> rim, corners;
  for (int k = 0; k < count; ++k)
    rim.push_back(sheet.vertex(on_circle(radius, k, count)));
  for (int c = 0; c < 4; ++c)
    corners.push_back(sheet.vertex(std::sqrt(2.0) * on_circle(half, 2 * c + 1, 8)));
  for (int k = 0; k < count; ++k)
    sheet.triangle(corners[4 * k / count], rim[(k + 1) % count], rim[k]);
  for (int c = 0; c < 4; ++c)
    sheet.triangle(corners[c], corners[(c + 1) % 4], rim[(c + 1) * count / 4 % count]);
  return sheet;
}

double area_of(const Scene& scene) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    area += area_vector(corners(scene, TriangleId{t})).y;
  return area;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Directed edges that no other triangle runs along the other way.
std::set<Edge> outline_of(const Scene& scene) {
  std::set<Edge> edges, outline;
  for (const Triangle& triangle : scene.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(
          edges.emplace(index(triangle.vertices[k]), index(triangle.vertices[(k + 1) % 3])).second);
  for (const Edge& edge : edges)
    if (!edges.contains({edge.second, edge.first}))
      outline.insert(edge);
  return outline;
}

/// What patches take, in units of the surface's area.
double wanted_share(const Scene& scene) {
  double wanted = 0.0, area = 0.0;
  for (const Patch& patch : find_surfaces(scene).patches) {
    const auto edge = [&](std::size_t a, std::size_t b) {
      return glm::distance(patch.corners[a], patch.corners[b]);
    };
    const double longest = std::max({edge(0, 1), edge(1, 2), edge(2, 0)});
    wanted += patch.corner_count == 3
                  ? 0.5 * longest * longest
                  : std::max(edge(0, 1), edge(2, 3)) * std::max(edge(1, 2), edge(3, 0));
    area += patch.area;
  }
  return wanted / area;
}

void expect_mended(Sheet sheet, double share) {
  const Scene before = sheet.scene;
  ASSERT_TRUE(retriangulate_slivers(sheet.scene, find_surfaces(sheet.scene)));
  const Scene& after = sheet.scene;
  // The outline is the same to the bit, so the area is the same but for rounding.
  EXPECT_EQ(outline_of(after), outline_of(before));
  EXPECT_NEAR(area_of(after), area_of(before), 1e-12 * area_of(before));
  for (std::size_t v = 0; v < before.vertices.size(); ++v)
    EXPECT_EQ(after.vertices[v].position, before.vertices[v].position);
  for (std::uint32_t t = 0; t < after.triangles.size(); ++t)
    EXPECT_GT(area_vector(corners(after, TriangleId{t})).y, 0.0);
  // What was one surface is one, of one front and material.
  EXPECT_EQ(find_surfaces(after).surfaces.size(), 1u);
  EXPECT_GT(wanted_share(before), 3.0);
  EXPECT_LT(wanted_share(after), share);
  // Once is enough.
  Scene again = after;
  EXPECT_FALSE(retriangulate_slivers(again, find_surfaces(again)));
}

TEST(Retriangulation, MendsFansRingsAndStars) {
  // Well-shaped triangles take about 1.2 to 2 of their area; without cuts in the outline
  // a few by its edges take more.
  expect_mended(fan_about_middle(96, 2.5), 2.0);
  expect_mended(fan_about_middle(1000, 2.5), 2.0);
  std::vector<Point3> disc, star;
  for (int k = 0; k < 200; ++k)
    disc.push_back(on_circle(3.0, k, 200));
  expect_mended(fan_about_corner(disc), 2.0);
  // The four sides of the floor, 8 m long, are not cut: the triangles on them take 32 m^2 each,
  // 2.1 of the floor, and are half of it. The other half takes three times its area at most.
  expect_mended(floor_with_hole(160, 1.0, 4.0), 3.7);
}

TEST(Retriangulation, AStarOfSpikesKeepsItsSpikes) {
  Sheet sheet;
  const int count = 64;
  const VertexId middle = sheet.vertex(Point3(0.0));
  std::vector<VertexId> rim;
  for (int k = 0; k < 2 * count; ++k)
    rim.push_back(sheet.vertex(on_circle(k % 2 == 0 ? 3.0 : 2.0, k, 2 * count)));
  for (int k = 0; k < 2 * count; ++k)
    sheet.triangle(middle, rim[k], rim[(k + 1) % (2 * count)]);
  // Spikes 1 m long and 0.2 m wide stay triangles of that shape: 64 of them take half a square
  // metre each of the 19 there are, 1.7 of the area. The disc within them, 0.66 of the area, takes
  // three times its own at most.
  expect_mended(sheet, 3.7);
}

/// All of a sheet, larger and somewhere else.
Sheet moved(Sheet sheet, double times, const Point3& to) {
  for (Vertex& vertex : sheet.scene.vertices)
    vertex.position = times * vertex.position + to;
  sheet.scene.position_error = 1e-15 * (times * 10.0 + glm::length(to));
  return sheet;
}

TEST(Retriangulation, MendsAtAnySizeAndPlace) {
  expect_mended(moved(fan_about_middle(96, 2.5), 1e-6, Point3(0.0)), 2.0);
  expect_mended(moved(fan_about_middle(96, 2.5), 1e6, Point3(0.0)), 2.0);
  expect_mended(moved(floor_with_hole(160, 1.0, 4.0), 1.0, Point3(3e4, 10.0, -5e4)), 3.7);
}

TEST(Retriangulation, KeepsConcaveOutlinesAndVerticesThatTouch) {
  // A comb of sixteen teeth is a fan about a corner of its back, with ears in the gaps.
  Sheet comb;
  const VertexId from = comb.vertex({0.0, 0.0, 0.0});
  std::vector<VertexId> low, high;
  for (int k = 0; k <= 16; ++k)
    low.push_back(comb.vertex({0.5 * k, 0.0, -4.0}));
  for (int k = 0; k < 16; ++k)
    high.push_back(comb.vertex({0.5 * k + 0.25, 0.0, -6.0}));
  for (int k = 0; k < 16; ++k) {
    comb.triangle(from, low[k + 1], low[k]);
    comb.triangle(low[k], low[k + 1], high[k]);
  }
  for (Triangle& triangle : comb.scene.triangles)
    if (area_vector({position(comb.scene, triangle.vertices[0]),
                     position(comb.scene, triangle.vertices[1]),
                     position(comb.scene, triangle.vertices[2])})
            .y < 0.0)
      std::swap(triangle.vertices[1], triangle.vertices[2]);
  // The teeth, 2 m long, take 2 m^2 each, 1.4 times the 24 m^2 there are; triangles on the uncut
  // sides of 4 and 9 m take 2.0 times that. What is left, two thirds, takes three times its area at
  // most.
  expect_mended(comb, 5.4);

  // Two fans share one vertex of their rims and no edge: two surfaces, each mended by itself.
  Sheet two = fan_about_middle(96, 2.5);
  const VertexId shared{1};
  std::vector<VertexId> rim{shared};
  const VertexId middle = two.vertex({5.0, 0.0, 0.0});
  for (int k = 1; k < 96; ++k)
    rim.push_back(two.vertex(Point3(5.0, 0.0, 0.0) - on_circle(2.5, k, 96)));
  for (int k = 0; k < 96; ++k)
    two.triangle(middle, rim[k], rim[(k + 1) % 96]);
  const auto before = outline_of(two.scene);
  ASSERT_TRUE(retriangulate_slivers(two.scene, find_surfaces(two.scene)));
  EXPECT_EQ(outline_of(two.scene), before);
  EXPECT_LT(wanted_share(two.scene), 2.0);
}

TEST(Retriangulation, NearlyFlatStaysOneSurface) {
  // Heights are off by 0.1 mm either way, as positions of 14 bits are.
  Sheet sheet = fan_about_middle(96, 2.5);
  sheet.scene.position_error = 1e-4;
  for (std::size_t v = 0; v < sheet.scene.vertices.size(); ++v)
    sheet.scene.vertices[v].position.y = v % 3 == 0 ? 1e-4 : v % 3 == 1 ? -1e-4 : 0.0;
  ASSERT_EQ(find_surfaces(sheet.scene).surfaces.size(), 1u);
  ASSERT_TRUE(retriangulate_slivers(sheet.scene, find_surfaces(sheet.scene)));
  EXPECT_EQ(find_surfaces(sheet.scene).surfaces.size(), 1u);
}

TEST(Retriangulation, AGroundFarBeyondTheRoomIsLeftAlone) {
  // Its new vertices would outnumber those of the room, and count as the detail of the scene.
  Sheet ground = moved(fan_about_middle(24, 2.5), 1e5, Point3(0.0, -1.0, 0.0));
  for (int k = 0; k < 8; ++k)
    add_room(ground.scene, Point3(5.0 * k, 0.0, 0.0), Point3(4.0, 3.0, 5.0), {});
  ASSERT_FALSE(find_surfaces(ground.scene).detail.is_all);
  EXPECT_FALSE(retriangulate_slivers(ground.scene, find_surfaces(ground.scene)));
}

TEST(Retriangulation, LeavesGoodSurfacesAndWhatItCannotKeep) {
  Scene room;
  add_room(room, Point3(0.0), Point3(4.0, 3.0, 5.0), {});
  EXPECT_FALSE(retriangulate_slivers(room, find_surfaces(room)));

  Sheet lamp = fan_about_middle(96, 2.5);
  lamp.scene.materials[0] = diffuse(0.0, 1.0);
  EXPECT_FALSE(retriangulate_slivers(lamp.scene, find_surfaces(lamp.scene)));

  // Colours that bend from triangle to triangle are not those of other triangles.
  Sheet coloured = fan_about_middle(96, 2.5);
  for (std::size_t v = 0; v < coloured.scene.vertices.size(); v += 2)
    own_attributes(coloured.scene, coloured.scene.vertices[v]).color = {0.5F, 0.2F, 0.1F, 1.0F};
  EXPECT_FALSE(retriangulate_slivers(coloured.scene, find_surfaces(coloured.scene)));

  // Half of the disc belongs to another node, whose name and light are its own.
  Sheet shared = fan_about_middle(96, 2.5);
  shared.scene.nodes.push_back({"half"});
  for (std::size_t t = 0; t < 48; ++t)
    shared.scene.triangles[t].node = NodeId{1};
  EXPECT_FALSE(retriangulate_slivers(shared.scene, find_surfaces(shared.scene)));

  // Sheets that run along an edge three at a time are no surface with one inside.
  Sheet crossing = fan_about_middle(96, 2.5);
  const auto rim = crossing.scene.triangles;
  for (const Triangle& triangle : rim)
    crossing.scene.triangles.push_back(triangle);
  const Scene as_it_was = crossing.scene;
  EXPECT_FALSE(retriangulate_slivers(crossing.scene, find_surfaces(crossing.scene)));
  EXPECT_EQ(crossing.scene.triangles.size(), as_it_was.triangles.size());
}

TEST(Retriangulation, AffineTextureCoordinatesGoOn) {
  Sheet sheet = fan_about_middle(96, 2.5);
  sheet.scene.textures.push_back({"image", {}});
  sheet.scene.materials[0].base_color_texture = TextureUse{TextureId{0}};
  const auto uv_of = [](const Point3& p) { return glm::vec2(0.3 + 0.2 * p.x, 0.7 * p.z - p.x); };
  for (Vertex& vertex : sheet.scene.vertices)
    own_attributes(sheet.scene, vertex).texcoord[0] = uv_of(vertex.position);
  ASSERT_TRUE(retriangulate_slivers(sheet.scene, find_surfaces(sheet.scene)));
  ASSERT_GT(sheet.scene.vertices.size(), 97u);
  for (const Vertex& vertex : sheet.scene.vertices)
    EXPECT_LT(glm::distance(attributes_of(sheet.scene, vertex).texcoord[0], uv_of(vertex.position)),
              1e-5F);

  // A seam: the same place has two coordinates, which one function cannot give.
  Sheet seam = fan_about_middle(96, 2.5);
  seam.scene.textures.push_back({"image", {}});
  seam.scene.materials[0].base_color_texture = TextureUse{TextureId{0}};
  for (Vertex& vertex : seam.scene.vertices)
    own_attributes(seam.scene, vertex).texcoord[0] = uv_of(vertex.position);
  const VertexId copy = seam.vertex(position(seam.scene, VertexId{1}));
  own_attributes(seam.scene, seam.scene.vertices[index(copy)]).texcoord[0] = {4.0F, 4.0F};
  seam.scene.triangles[95].vertices[2] = copy;
  EXPECT_FALSE(retriangulate_slivers(seam.scene, find_surfaces(seam.scene)));
}

TEST(Retriangulation, TangentsOfNormalMapsGoOn) {
  Sheet sheet = fan_about_middle(96, 2.5);
  sheet.scene.textures.push_back({"map", {}});
  sheet.scene.materials[0].normal_texture = TextureUse{TextureId{0}};
  const glm::vec4 along(0.6F, 0.0F, 0.8F, -1.0F);
  sheet.scene.tangents.assign(sheet.scene.vertices.size(), along);
  Sheet turning = sheet;
  ASSERT_TRUE(retriangulate_slivers(sheet.scene, find_surfaces(sheet.scene)));
  ASSERT_GT(sheet.scene.vertices.size(), 97u);
  ASSERT_EQ(sheet.scene.tangents.size(), sheet.scene.vertices.size());
  for (const glm::vec4& tangent : sheet.scene.tangents)
    EXPECT_LT(glm::distance(tangent, along), 1e-5F);

  turning.scene.tangents[7] = {0.8F, 0.0F, -0.6F, -1.0F};
  EXPECT_FALSE(retriangulate_slivers(turning.scene, find_surfaces(turning.scene)));
}

} // namespace
} // namespace meninas::test
