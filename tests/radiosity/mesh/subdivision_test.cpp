#include "radiosity/field/interpolation.h"
#include "radiosity/mesh/element_lookup.h"
#include "radiosity/mesh/subdivision.h"
#include "tests/radiosity/meshed.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

namespace meninas::test {
namespace {

/// Divided several times, each time a random choice of a few elements.
ElementMesh divided_at_random(const Meshed& m, int times, double share, std::uint32_t seed) {
  Random random(seed);
  ElementMesh mesh = m.mesh;
  for (int k = 0; k < times; ++k) {
    std::vector<std::uint8_t> marked(element_count(mesh), 0);
    for (auto& mark : marked)
      mark = random.between(0.0, 1.0) < share ? 1 : 0;
    mesh = divide_elements(mesh, m.surfaces, marked);
  }
  return mesh;
}

std::vector<Scene> scenes() {
  std::vector<Scene> scenes{square(), all_shapes(), patched_wall(), half_room()};
  scenes.push_back(transformed(patched_wall(), glm::dmat3(1.0), 1e-3, Vec3(3.0, -2.0, 1.0)));
  return scenes;
}

TEST(MeshDivision, NothingMarkedNothingChanged) {
  const Meshed m = meshed(half_room(), {.element_size = 0.4});
  const ElementMesh same =
      divide_elements(m.mesh, m.surfaces, std::vector<std::uint8_t>(element_count(m.mesh), 0));
  EXPECT_EQ(same.vertices, m.mesh.vertices);
  EXPECT_EQ(same.corners, m.mesh.corners);
  EXPECT_EQ(same.area, m.mesh.area);
  EXPECT_TRUE(same.hanging.empty());
}

// What a division makes of elements weighs as much: as much in all, in the same places.
TEST(MeshDivision, PartsHaveTheWeightsOfTheirElements) {
  for (const Scene& scene : scenes()) {
    const Meshed m = meshed(scene, {.element_size = 0.3});
    const ElementMesh finer = divided_at_random(m, 3, 0.2, 7);
    std::vector<float> weights(element_count(m.mesh), 0.0F);
    for (std::size_t e = 0; e < weights.size(); ++e)
      weights[e] = 0.5F * static_cast<float>(index(m.mesh.cell_of_element[e]) % 3); // one for a cell
    const std::vector<float> parts = parts_of(m.mesh, weights, finer);
    ASSERT_EQ(parts.size(), element_count(finer));
    double before = 0.0, after = 0.0, all = 0.0;
    for (std::size_t e = 0; e < weights.size(); ++e) {
      before += double{weights[e]} * m.mesh.area[e];
      all += m.mesh.area[e];
    }
    for (std::size_t e = 0; e < parts.size(); ++e)
      after += double{parts[e]} * finer.area[e];
    EXPECT_NEAR(after, before, 1e-9 * all);
    for (std::uint32_t e = 0; e < parts.size(); ++e) {
      const MeshCell& cell = cell_of(finer, ElementId{e});
      const Vec2 uv = patch_uv_of(finer, cell, Vec2(0.3, 0.3));
      EXPECT_EQ(parts[e], weights[index(locate(m.mesh, cell.side, uv).element)]) << e;
    }
    EXPECT_TRUE(parts_of(m.mesh, {}, finer).empty());
  }
}

// Four elements in the place of one, and their edges' middles: the smallest case, by hand.
TEST(MeshDivision, OneSquareIntoFour) {
  const Meshed m = meshed(square(), {.element_size = 0.5});
  const ElementMesh mesh =
      divide_elements(m.mesh, m.surfaces, std::vector<std::uint8_t>{1, 0, 0, 0});
  EXPECT_EQ(element_count(mesh), 7U);
  EXPECT_EQ(mesh.vertices.size(), 9U + 5U);
  EXPECT_NEAR(mesh.area[0], 1.0 / 16.0, 1e-15);
  ASSERT_EQ(mesh.hanging.size(), 2U); // in the middle of the edges to the right and above
  for (const HangingVertex& h : mesh.hanging)
    EXPECT_EQ(mesh.vertices[index(h.vertex)],
              0.5 * (mesh.vertices[index(h.end_a)] + mesh.vertices[index(h.end_b)]));
  EXPECT_EQ(size_of(mesh, ElementId{0}), 0.25);
  EXPECT_EQ(size_of(mesh, ElementId{6}), 0.5);
}

TEST(MeshDivision, ElementsOfASideStandInARowAndFillIt) {
  for (const Scene& scene : scenes()) {
    const Meshed m = meshed(scene, {.target_elements = 150});
    const ElementMesh mesh = divided_at_random(m, 4, 0.15, 1);
    ASSERT_GT(element_count(mesh), 2 * element_count(m.mesh));
    std::uint32_t next = 0;
    for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
      const MeshSide& side = mesh.sides[s];
      EXPECT_EQ(side.first_element, next);
      double area = 0.0;
      for (std::uint32_t e = next; e < next + side.element_count; ++e) {
        EXPECT_EQ(index(mesh.side_of_element[e]), s);
        const MeshCell& cell = cell_of(mesh, ElementId{e});
        EXPECT_TRUE(cell.first_element <= e && e < cell.first_element + cell.element_count);
        area += mesh.area[e];
      }
      next += side.element_count;
      const double patch = m.surfaces.patches[index(side.patch)].area;
      EXPECT_NEAR(area, patch, 1e-12 * patch);
    }
    EXPECT_EQ(next, element_count(mesh));
  }
}

TEST(MeshDivision, CellsFollowTheirParentsAndSumThem) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.5});
  const ElementMesh mesh = divided_at_random(m, 4, 0.2, 2);
  for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
    const MeshCell& cell = mesh.cells[c];
    if (is_leaf(cell)) {
      EXPECT_EQ(mesh.area[cell.first_element], cell.area);
      continue;
    }
    ASSERT_GT(index(cell.first_child), c);
    double area = 0.0;
    std::uint32_t next = cell.first_element;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const MeshCell& child = mesh.cells[index(cell.first_child) + k];
      EXPECT_EQ(index(child.parent), c);
      EXPECT_EQ(child.level, cell.level + 1);
      EXPECT_EQ(child.first_element, next);
      next += child.element_count;
      area += child.area;
    }
    EXPECT_EQ(next, cell.first_element + cell.element_count);
    EXPECT_NEAR(area, cell.area, 1e-12 * cell.area);
  }
}

// From element and (s, t) to (u, v) of the patch and back,
// and the same in the single precision of the inner loops.
TEST(MeshDivision, LocateFindsEveryElement) {
  for (const Scene& scene : scenes()) {
    const Meshed m = meshed(scene, {.target_elements = 100});
    const ElementMesh mesh = divided_at_random(m, 4, 0.15, 3);
    const ElementTable table = make_element_table(mesh);
    Random random(4);
    for (std::uint32_t e = 0; e < element_count(mesh); ++e) {
      const MeshCell& cell = cell_of(mesh, ElementId{e});
      Vec2 st(random.between(0.02, 0.98), random.between(0.02, 0.98));
      if (mesh.sides[index(cell.side)].triangle && st.x + st.y > 0.98)
        st = 0.99 - st;
      st = glm::max(st, Vec2(0.01));
      const Vec2 uv = patch_uv_of(mesh, cell, st);
      const ElementPoint at = locate(mesh, cell.side, uv);
      // Of a leaf on which something stands, one of its regions.
      ASSERT_EQ(mesh.cell_of_element[index(at.element)], mesh.cell_of_element[e]);
      if (cell.element_count == 1) {
        ASSERT_EQ(index(at.element), e);
      }
      EXPECT_LT(glm::distance(at.st, st), 1e-10);
      const Landing landing = land(table, index(cell.side), glm::vec2(uv));
      ASSERT_EQ(landing.element, index(at.element));
      EXPECT_LT(glm::distance(Vec2(landing.st), st), 1e-4); // 6e-8 by 40 divisions and 2^4
    }
  }
}

/// Points on the borders between elements, where they are of two of them.
TEST(MeshDivision, TheFieldIsContinuous) {
  for (const Scene& scene : scenes()) {
    const Meshed m = meshed(scene, {.target_elements = 100});
    const ElementMesh mesh = divided_at_random(m, 4, 0.15, 5);
    EXPECT_FALSE(mesh.hanging.empty());
    Random random(6);
    VertexIrradiance field;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      field.irradiance.emplace_back(random.between(0.0, 1.0), random.between(0.0, 1.0),
                                    random.between(0.0, 1.0));
    settle_hanging(mesh, field.irradiance);
    for (std::uint32_t e = 0; e < element_count(mesh); ++e) {
      const MeshCell& cell = cell_of(mesh, ElementId{e});
      // From a little inside the element over its edge t = 0 to as far beyond it.
      for (const double s : {0.2, 0.5, 0.7}) {
        constexpr double step = 1e-7;
        const Vec2 inside = patch_uv_of(mesh, cell, Vec2(s, step)),
                   outside = patch_uv_of(mesh, cell, Vec2(s, -step));
        if (outside.y < 0.0 || outside.x + outside.y > 1.0)
          continue;
        // Light jumps where something stands.
        const auto stands_at = [&](Vec2 uv) {
          const ElementCorners& corners = mesh.corners[index(locate(mesh, cell.side, uv).element)];
          return std::ranges::any_of(
              corners, [&](ElementVertexId v) { return is_at_contact(mesh, index(v)); });
        };
        if (stands_at(inside) || stands_at(outside))
          continue;
        EXPECT_LT(glm::distance(irradiance_at(mesh, field, cell.side, inside),
                                irradiance_at(mesh, field, cell.side, outside)),
                  1e-5F);
      }
    }
  }
}

// Along the edge x = 1 that two patches of one surface share.
TEST(MeshDivision, TheFieldIsContinuousAcrossPatches) {
  const Meshed m = meshed(patched_wall(), {.element_size = 0.3});
  const ElementMesh mesh = divided_at_random(m, 5, 0.15, 7);
  Random random(8);
  VertexIrradiance field;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    field.irradiance.emplace_back(random.between(0.0, 1.0));
  settle_hanging(mesh, field.irradiance);
  const auto value_at = [&](const std::string& node, const Point3& x) {
    for (std::uint32_t s = 0; s < mesh.sides.size(); ++s)
      if (m.scene.nodes[index(mesh.sides[s].node)].name == node)
        return irradiance_at(mesh, field, SideId{s},
                             uv_at(m.surfaces.patches[index(mesh.sides[s].patch)], x))
            .x;
    return std::numeric_limits<float>::quiet_NaN();
  };
  for (int k = 0; k <= 200; ++k) {
    const Point3 x(1.0, k / 200.0, 0.0), above(k / 200.0, 1.0, 0.0);
    EXPECT_NEAR(value_at("square", x), value_at("right", x), 1e-5F);
    EXPECT_NEAR(value_at("square", above), value_at("above", above), 1e-5F);
  }
}

/// Vertices on edges of elements, not at their ends,
/// that are not in the middle or do not hang there; of edges that reach above y.
std::size_t cracks(const ElementMesh& mesh, double y = -1e300) {
  std::vector<std::uint8_t> hangs(mesh.vertices.size(), 0);
  for (const HangingVertex& h : mesh.hanging)
    hangs[index(h.vertex)] = 1;
  std::size_t count = 0;
  for (const ElementCorners& corners : mesh.corners) {
    const std::size_t edges = corners[3] == corners[2] ? 3 : 4;
    for (std::size_t k = 0; k < edges; ++k) {
      const Point3 a = mesh.vertices[index(corners[k])],
                   b = mesh.vertices[index(corners[(k + 1) % edges])];
      if (std::max(a.y, b.y) <= y)
        continue;
      for (std::size_t v = 0; v < hangs.size(); ++v) {
        const Point3& x = mesh.vertices[v];
        const double along = glm::dot(x - a, b - a) / glm::dot(b - a, b - a);
        const bool on_edge = glm::distance(x, glm::mix(a, b, along)) < 1e-9;
        if (on_edge && along > 1e-6 && along < 1 - 1e-6 &&
            (std::abs(along - 0.5) > 1e-9 || hangs[v] == 0))
          ++count;
      }
    }
  }
  return count;
}

// Two elements that share a part of an edge are of like size:
// a vertex lies on an edge at its middle or not at all.
TEST(MeshDivision, NeighboursDifferByOneLevel) {
  const Meshed m = meshed(patched_wall(), {.element_size = 0.5});
  ElementMesh mesh = m.mesh;
  // Towards one corner, as deep as six levels: everything around has to follow.
  for (int k = 0; k < 6; ++k) {
    std::vector<std::uint8_t> marked(element_count(mesh), 0);
    for (std::size_t e = 0; e < marked.size(); ++e)
      for (const auto v : mesh.corners[e])
        if (glm::distance(mesh.vertices[index(v)], Point3(1.0, 1.0, 0.0)) < 1e-6)
          marked[e] = 1;
    mesh = divide_elements(mesh, m.surfaces, marked);
  }
  int deepest = 0;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    deepest = std::max<int>(deepest, cell_of(mesh, static_cast<ElementId>(e)).level);
  EXPECT_EQ(deepest, 6);
  EXPECT_EQ(cracks(mesh), 0U);
}

/// Patches of one surface whose divisions into roots are not alike: a sliver along a square,
/// and squares that end in the middle of others' edges.
std::vector<Scene> unlike_roots() {
  const auto one_surface = [](const std::vector<std::vector<Point3>>& polygons) {
    Scene scene;
    for (const auto& corners : polygons)
      add_polygon(scene, "part", corners, diffuse(0.5));
    for (auto& triangle : scene.triangles)
      triangle.material = MaterialId{0};
    return scene;
  };
  const auto rectangle = [](double x, double y, double to_x, double to_y) {
    return std::vector<Point3>{{x, y, 0}, {to_x, y, 0}, {to_x, to_y, 0}, {x, to_y, 0}};
  };
  // What is beside the large one joins it to the small ones, no edge of which it has.
  std::vector<std::vector<Point3>> large_on_small{rectangle(0, 0, 8, 8), rectangle(8, 0, 9, 8),
                                                  rectangle(8, -0.5, 9, 0)};
  for (double x = 0.0; x < 8.0; x += 0.5)
    large_on_small.push_back(rectangle(x, -0.5, x + 0.5, 0));
  return {one_surface({rectangle(0, 0, 8, 8), {{0, 0, 0}, {4, -0.02, 0}, {8, 0, 0}}}),
          one_surface({rectangle(0, 0, 2, 1), rectangle(0, 1, 1, 2), rectangle(1, 1, 2, 2),
                       rectangle(2, 0, 3, 1), rectangle(2, 1, 3, 2)}),
          one_surface(large_on_small)};
}

// A sliver of one root along eight of a square: their vertices meet, and what is larger there
// follows, and what is larger than that within its patch, too.
TEST(MeshDivision, NeighboursDifferByOneLevelBesideSlivers) {
  const Meshed m = meshed(unlike_roots().front(), {.element_size = 1.0});
  ElementMesh mesh = m.mesh;
  ASSERT_EQ(element_count(mesh), 65U);
  for (int k = 0; k < 5; ++k) {
    std::vector<std::uint8_t> marked(element_count(mesh), 0);
    for (std::uint32_t e = 0; e < marked.size(); ++e)
      marked[e] = mesh.corners[e][3] == mesh.corners[e][2] ? 1 : 0;
    mesh = divide_elements(mesh, m.surfaces, marked);
    EXPECT_EQ(cracks(mesh), 0U) << k;
  }
}

// A square of one root on sixteen small ones follows by several levels at once.
TEST(MeshDivision, NeighboursDifferByOneLevelAboveSmallPatches) {
  const Meshed m = meshed(unlike_roots().back(), {.element_size = 8.0});
  ASSERT_EQ(element_count(m.mesh), 19U);
  std::vector<std::uint8_t> marked(19, 0);
  marked[3] = 1; // at a corner of the large one
  const ElementMesh mesh = divide_elements(m.mesh, m.surfaces, marked);
  EXPECT_GT(element_count(mesh), 30U);
  EXPECT_EQ(cracks(mesh, 0.0), 0U);
}

// A division takes what stays from the mesh before and asks for new vertices by place;
// from the roots all vertices are asked for: the two are the same mesh.
TEST(MeshDivision, AMeshIsItsRootsAndItsDivision) {
  std::vector<Scene> all = scenes();
  std::ranges::move(unlike_roots(), std::back_inserter(all));
  for (const Scene& scene : all)
    for (const double elements : {20.0, 64.0, 100.0, 700.0}) {
      const Meshed m = meshed(scene, {.target_elements = elements});
      const ElementMesh mesh = divided_at_random(m, 4, 0.15, 9);
      const std::vector<std::uint8_t> division = division_of(mesh);
      ASSERT_TRUE(is_division_of(m.mesh, division));
      const ElementMesh again = divided_mesh(m.mesh, m.surfaces, division);
      EXPECT_EQ(again.vertices, mesh.vertices);
      EXPECT_EQ(again.corners, mesh.corners);
      EXPECT_EQ(again.area, mesh.area);
      EXPECT_EQ(again.element_of_vertex, mesh.element_of_vertex);
      ASSERT_EQ(again.hanging.size(), mesh.hanging.size());
      for (std::size_t k = 0; k < mesh.hanging.size(); ++k)
        EXPECT_EQ(again.hanging[k].vertex, mesh.hanging[k].vertex);
    }
}

TEST(MeshDivision, WrongDivisionsAreKnown) {
  const Meshed m = meshed(half_room(), {.target_elements = 100});
  const std::vector<std::uint8_t> division = division_of(divided_at_random(m, 4, 0.15, 9));
  auto cut = division, wrong = division, deep = std::vector<std::uint8_t>(division.size(), 1);
  cut.pop_back();
  wrong[3] = 7;
  EXPECT_FALSE(is_division_of(m.mesh, cut));
  EXPECT_FALSE(is_division_of(m.mesh, wrong));
  EXPECT_FALSE(is_division_of(m.mesh, deep));
}

// A sliver is left alone, however often it is marked: its vertices would fall together.
TEST(MeshDivision, SliversAreNotDividedForEver) {
  Scene scene;
  add_polygon(scene, "sliver", {{0, 0, 0}, {2, 0, 0}, {2, 1e-6, 0}}, diffuse(0.5));
  add_polygon(scene, "beside", {{0, 0, 0}, {2, 0, 0}, {2, -1, 0}, {0, -1, 0}}, diffuse(0.5));
  const Meshed m = meshed(std::move(scene), {.element_size = 0.5});
  const ElementMesh mesh = divided_at_random(m, 5, 1.0, 12);
  EXPECT_LT(element_count(mesh), 20'000U);
  for (const double area : mesh.area)
    EXPECT_GT(area, 0.0);
}

// Nor are elements whose corners have fallen together already, as those do
// that are smaller than the distance at which points so far from the origin can be told apart.
TEST(MeshDivision, WhatHasBecomeOneVertexIsNotDivided) {
  Meshed m = meshed(square(), {.element_size = 0.5});
  m.surfaces.tolerance = 1.0;
  for (ElementCorners& corners : m.mesh.corners)
    corners.fill(corners.front());
  for (const CellId cell : m.mesh.cell_of_element)
    EXPECT_FALSE(is_divisible(m.mesh, m.surfaces, m.mesh.cells[index(cell)]));
}

} // namespace
} // namespace meninas::test
