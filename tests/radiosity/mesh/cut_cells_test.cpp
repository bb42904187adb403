// Leaves that are cut along what stands on them, when a mesh is divided.
#include "radiosity/mesh/subdivision.h"
#include "tests/radiosity/meshed.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

/// Floors that boxes and walls cut: apart, or along edges.
Scene cut_floors() {
  Scene scene;
  for (const double y : {0.0, 2.0, 4.0}) {
    add_polygon(scene, "floor", {{0, y, 1}, {1, y, 1}, {1, y, 0}, {0, y, 0}}, diffuse(0.5));
    add_box(scene, "box", {0.31, y, 0.27}, {0.73, y + 0.2, 0.61}, diffuse(0.5));
    add_polygon(scene, "wall", {{0, y, 0.8}, {1, y, 0.8}, {1, y + 0.3, 0.8}, {0, y + 0.3, 0.8}},
                double_sided(diffuse(0.5)));
  }
  return scene;
}

/// Vertices, elements, and the cuts through their leaves.
void expect_the_same(const ElementMesh& a, const ElementMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.element_of_vertex, b.element_of_vertex);
  EXPECT_EQ(a.at_contact, b.at_contact);
  EXPECT_EQ(a.walled_edges, b.walled_edges);
  EXPECT_EQ(a.line_of_cell, b.line_of_cell);
  EXPECT_EQ(a.region_of_element, b.region_of_element);
  EXPECT_TRUE(std::ranges::equal(a.lines, b.lines, [](const CellLine& x, const CellLine& y) {
    return x.line == y.line && x.next == y.next;
  }));
  EXPECT_TRUE(
      std::ranges::equal(a.regions, b.regions, [](const RegionElement& x, const RegionElement& y) {
        return x.triangles == y.triangles && x.area_up_to == y.area_up_to &&
               x.centroid == y.centroid && x.corner_weights == y.corner_weights &&
               x.own_corners == y.own_corners;
      }));
}

// Where a division makes nothing new on a surface its leaves keep their cuts; from the roots all leaves are cut:
// the two are the same mesh.
TEST(CutCells, AreThoseOfAMeshMadeAnew) {
  for (const double elements : {60.0, 300.0, 1500.0}) {
    const Meshed m = meshed(cut_floors(), {.target_elements = elements});
    ASSERT_FALSE(m.mesh.lines.empty());
    Random random(3);
    ElementMesh mesh = m.mesh;
    for (int time = 0; time < 6; ++time) {
      // One element alone, so that most surfaces stay as they are.
      std::vector<std::uint8_t> marked(element_count(mesh), 0);
      const double which = random.between(0.0, 1.0) * static_cast<double>(marked.size());
      marked[static_cast<std::size_t>(which)] = 1;
      mesh = divide_elements(mesh, m.surfaces, marked);
      expect_the_same(mesh, divided_mesh(m.mesh, m.surfaces, division_of(mesh)));
    }
    EXPECT_GT(element_count(mesh), element_count(m.mesh));
  }
}

} // namespace
} // namespace meninas::test
