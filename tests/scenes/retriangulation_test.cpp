// Flat surfaces of slivers are triangulated anew within the outline they had.
#include "scenes/retriangulation.h"
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
      EXPECT_TRUE(edges
                      .emplace(index(triangle.vertices[k]), index(triangle.vertices[(k + 1) % 3]))
                      .second);
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
    wanted += patch.corner_count == 3 ? 0.5 * longest * longest
                                      : std::max(edge(0, 1), edge(2, 3)) *
                                            std::max(edge(1, 2), edge(3, 0));
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
  // 2.1 of the area besides the 2 of the rest.
  expect_mended(floor_with_hole(160, 1.0, 4.0), 4.0);
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
  // metre each of the 19 there are, 1.7 of the area besides the 2 of the rest.
  expect_mended(sheet, 4.0);
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
    coloured.scene.vertices[v].color = {0.5F, 0.2F, 0.1F, 1.0F};
  EXPECT_FALSE(retriangulate_slivers(coloured.scene, find_surfaces(coloured.scene)));
}

TEST(Retriangulation, AffineTextureCoordinatesGoOn) {
  Sheet sheet = fan_about_middle(96, 2.5);
  sheet.scene.textures.push_back({"image", {}});
  sheet.scene.materials[0].base_color_texture = TextureUse{TextureId{0}};
  const auto uv_of = [](const Point3& p) { return glm::vec2(0.3 + 0.2 * p.x, 0.7 * p.z - p.x); };
  for (Vertex& vertex : sheet.scene.vertices)
    vertex.texcoord[0] = uv_of(vertex.position);
  ASSERT_TRUE(retriangulate_slivers(sheet.scene, find_surfaces(sheet.scene)));
  ASSERT_GT(sheet.scene.vertices.size(), 97u);
  for (const Vertex& vertex : sheet.scene.vertices)
    EXPECT_LT(glm::distance(vertex.texcoord[0], uv_of(vertex.position)), 1e-5F);
}

} // namespace
} // namespace meninas::test
