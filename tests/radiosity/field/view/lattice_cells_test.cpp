#include "radiosity/field/view/cell_lookup.h"
#include "radiosity/field/view/lattice_cells.h"
#include "radiosity/mesh/make_mesh.h"
#include "radiosity/mesh/subdivision.h"
#include "tests/radiosity/meshed.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#include <numeric>

namespace meninas::test {
namespace {

std::vector<ElementId> all_elements(const ElementMesh& mesh) {
  std::vector<ElementId> all(element_count(mesh));
  for (std::uint32_t e = 0; e < all.size(); ++e)
    all[e] = ElementId{e};
  return all;
}

/// Some cells divided, some of their parts again, by chance.
LatticeCells divided_at_random(const ElementMesh& mesh, Random& random) {
  LatticeCells cells(mesh, all_elements(mesh));
  for (std::uint32_t c = 0; c < cells.cells().size(); ++c)
    if (cells.cells()[c].level < 6 && random.between(0.0, 1.0) < 0.3)
      cells.divide(c);
  return cells;
}

Point3 point_of(const Meshed& m, const LatticeCells& cells, const LatticeVertex& vertex) {
  const MeshSide& side = m.mesh.sides[index(m.mesh.side_of_element[index(vertex.element)])];
  return point_at(m.surfaces.patches[index(side.patch)], cells.place_in_patch(vertex));
}

TEST(LatticeCells, RootsHaveTheCornersOfTheirElements) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.31});
  const LatticeCells cells(m.mesh, all_elements(m.mesh));
  for (std::uint32_t e = 0; e < element_count(m.mesh); ++e)
    for (std::size_t c = 0; c < 4; ++c) {
      const LatticeVertex& vertex = cells.vertices()[cells.cells()[e].corners[c]];
      // Vertices of a mesh are welded within its grain.
      EXPECT_LT(
          glm::distance(point_of(m, cells, vertex), m.mesh.vertices[index(m.mesh.corners[e][c])]),
          1e-6);
    }
}

TEST(LatticeCells, VerticesOfOnePlaceOnASideAreOne) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.5});
  Random random(7);
  const LatticeCells cells = divided_at_random(m.mesh, random);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto& vertices = cells.vertices();
  ASSERT_GT(vertices.size(), 500U);
  for (std::uint32_t a = 0; a < vertices.size(); ++a)
    for (std::uint32_t b = a + 1; b < vertices.size(); ++b) {
      const auto side = [&](std::uint32_t v) {
        return m.mesh.side_of_element[index(vertices[v].element)];
      };
      if (side(a) == side(b) &&
          glm::distance(point_of(m, cells, vertices[a]), point_of(m, cells, vertices[b])) < 1e-9)
        pairs.emplace_back(a, b);
    }
  EXPECT_TRUE(pairs.empty()) << pairs.size();
}

TEST(LatticeCells, NewVerticesAreInTheMiddleOfWhatTheyAreBetween) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.5});
  Random random(3);
  const LatticeCells cells = divided_at_random(m.mesh, random);
  for (const LatticeVertex& vertex : cells.vertices()) {
    std::array<double, 2> sum{};
    for (const std::uint32_t v : vertex.between) {
      sum[0] += 0.25 * double(cells.vertices()[v].at.x);
      sum[1] += 0.25 * double(cells.vertices()[v].at.y);
    }
    EXPECT_EQ(sum[0], double(vertex.at.x));
    EXPECT_EQ(sum[1], double(vertex.at.y));
  }
}

// The cell that a point of a side is looked up in is one whose corners, weighed by the place in it,
// make up that point.
TEST(LatticeCells, LookupFindsTheCellsAndTheirPlaces) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.5});
  Random random(5);
  const LatticeCells cells = divided_at_random(m.mesh, random);
  constexpr std::size_t first_vertex = 1000;
  const FieldCells field = cell_lookup(m.mesh, cells, element_count(m.mesh), first_vertex);
  std::size_t divided = 0;
  for (std::uint32_t s = 0; s < m.mesh.sides.size(); ++s)
    for (int n = 0; n < 200; ++n) {
      Vec2 uv(random.between(0.001, 0.999), random.between(0.001, 0.999));
      if (m.mesh.sides[s].triangle && uv.x + uv.y > 0.999)
        uv = 0.9995 - uv;
      const Landing at = land(field.lookup, s, glm::vec2(uv));
      const ElementCorners& corners = field.corners[at.element];
      const auto place = [&](std::size_t c) {
        return cells.place_in_patch(cells.vertices()[index(corners[c]) - first_vertex]);
      };
      const double u = double{at.st.x}, v = double{at.st.y};
      const Vec2 found = m.mesh.sides[s].triangle
                             ? (1.0 - u - v) * place(0) + u * place(1) + v * place(2)
                             : (1.0 - v) * ((1.0 - u) * place(0) + u * place(1)) +
                                   v * ((1.0 - u) * place(3) + u * place(2));
      // A float of (u, v) is known to 6e-8; cells are not smaller than 1/64 of a root.
      EXPECT_LT(glm::distance(found, uv), 1e-6);
      divided += at.element >= 2 * element_count(m.mesh) ? 1 : 0;
    }
  EXPECT_GT(divided, 100U) << "or else nothing is tested";
}

TEST(LatticeCells, MiddlesOfEdgesAreFoundFromEitherSide) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.5});
  LatticeCells cells(m.mesh, all_elements(m.mesh));
  const LatticeCell before = cells.cells()[0];
  EXPECT_EQ(cells.middle_of(before.corners[0], before.corners[1]), LatticeCells::no_vertex);
  cells.divide(0);
  const std::uint32_t middle = cells.middle_of(before.corners[1], before.corners[0]);
  ASSERT_NE(middle, LatticeCells::no_vertex);
  EXPECT_EQ(cells.edge_middles(cells.cells()[0])[0], middle);
}

} // namespace
} // namespace meninas::test
