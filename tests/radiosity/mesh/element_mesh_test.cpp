#include "radiosity/mesh/element_lookup.h"
#include "scenes/errors.h"
#include "tests/radiosity/meshed.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

namespace meninas::test {
namespace {

TEST(ElementMesh, AreasAddUpToThePatches) {
  for (const double size : {0.03, 0.2, 1.0, 100.0}) {
    const Meshed m = meshed(all_shapes(), {.element_size = size});
    std::vector<double> sum(m.mesh.sides.size(), 0.0);
    for (std::size_t e = 0; e < element_count(m.mesh); ++e)
      sum[index(m.mesh.side_of_element[e])] += m.mesh.area[e];
    for (std::size_t s = 0; s < sum.size(); ++s) {
      const double area = m.surfaces.patches[index(m.mesh.sides[s].patch)].area;
      EXPECT_NEAR(sum[s], area, 1e-12 * area)
          << m.scene.nodes[index(m.mesh.sides[s].node)].name; // rounding of 1e4 sums
    }
  }
}

TEST(ElementMesh, ElementsAreInsideTheirSidesAndNumberedInARow) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.1});
  std::uint32_t next = 0;
  for (const auto& side : m.mesh.sides) {
    EXPECT_EQ(side.first_element, next);
    next += side.element_count;
    EXPECT_EQ(side.element_count, static_cast<std::uint32_t>(side.nu * side.nv));
    EXPECT_NEAR(glm::length(side.normal), 1.0, 1e-12);
  }
  EXPECT_EQ(next, element_count(m.mesh));
  for (const auto& corners : m.mesh.corners)
    for (const auto vertex : corners)
      EXPECT_LT(index(vertex), m.mesh.vertices.size());
}

// From element and (s, t) to (u, v) of the patch and back,
// and the same in the single precision of the inner loops.
TEST(ElementMesh, LocateInvertsPatchUv) {
  for (const double size : {0.05, 0.31, 10.0}) {
    const Meshed m = meshed(all_shapes(), {.element_size = size});
    Random random(1);
    const ElementTable table = make_element_table(m.mesh);
    for (std::uint32_t s = 0; s < m.mesh.sides.size(); ++s) {
      const MeshSide& side = m.mesh.sides[s];
      for (std::uint32_t local = 0; local < side.element_count; ++local) {
        const ElementId element{side.first_element + local};
        Vec2 st(random.between(0.01, 0.99), random.between(0.01, 0.99));
        if (side.triangle && st.x + st.y > 0.99)
          st = 0.995 - st;
        if (glm::any(glm::lessThan(st, Vec2(0.005))))
          st = Vec2(0.3);
        const Vec2 uv = patch_uv_of(m.mesh, cell_of(m.mesh, element), st);
        const ElementPoint at = locate(m.mesh, SideId{s}, uv);
        ASSERT_EQ(at.element, element);
        EXPECT_LT(glm::distance(at.st, st), 1e-11);
        const Landing landing = land(table, s, glm::vec2(uv));
        // A float of (u, v) is known to 6e-8, times at most 40 divisions.
        EXPECT_LT(glm::distance(Vec2(landing.st), st), 1e-5);
        ASSERT_EQ(landing.element, index(element));
      }
    }
  }
}

TEST(ElementMesh, LocateTakesEveryPointOfThePatch) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.17});
  for (std::uint32_t s = 0; s < m.mesh.sides.size(); ++s) {
    const MeshSide& side = m.mesh.sides[s];
    for (int i = -1; i <= 65; ++i)
      for (int j = -1; j <= 65; ++j) {
        const Vec2 uv(i / 64.0, j / 64.0);
        if (side.triangle && uv.x + uv.y > 1.0 + 1e-9)
          continue;
        const ElementPoint at = locate(m.mesh, SideId{s}, uv);
        EXPECT_GE(index(at.element), side.first_element);
        EXPECT_LT(index(at.element), side.first_element + side.element_count);
        EXPECT_TRUE(at.st.x >= 0.0 && at.st.x <= 1.0 && at.st.y >= 0.0 && at.st.y <= 1.0);
      }
  }
}

TEST(ElementMesh, VerticesLieWhereTheirElementsSay) {
  const Meshed m = meshed(all_shapes(), {.element_size = 0.2});
  for (std::size_t e = 0; e < element_count(m.mesh); ++e) {
    const MeshSide& side = m.mesh.sides[index(m.mesh.side_of_element[e])];
    const Patch& patch = m.surfaces.patches[index(side.patch)];
    const MeshCell& cell = cell_of(m.mesh, static_cast<ElementId>(e));
    const auto at = [&](double s, double t) {
      return point_at(patch, patch_uv_of(m.mesh, cell, {s, t}));
    };
    const std::array<Point3, 4> points{at(0, 0), at(1, 0), side.triangle ? at(0, 1) : at(1, 1),
                                       at(0, 1)};
    for (std::size_t c = 0; c < 4; ++c) // welded within 1e-7 of an element
      EXPECT_LT(glm::distance(m.mesh.vertices[index(m.mesh.corners[e][c])], points[c]), 1e-6 * 0.2);
  }
}

TEST(ElementMesh, AGridSharesItsVertices) {
  const Meshed m = meshed(square(), {.element_size = 0.1});
  EXPECT_EQ(element_count(m.mesh), 100U);
  EXPECT_EQ(m.mesh.vertices.size(), 121U);
}

TEST(ElementMesh, PatchesOfASurfaceConform) {
  const Meshed m = meshed(patched_wall(), {.element_size = 0.13});
  ASSERT_EQ(m.surfaces.surfaces.size(), 1U);
  // Along the shared edges x = 1 (0 < y < 1) and y = 1,
  // a vertex of either patch is one of the other's.
  const auto on = [&m](SideId side, auto&& predicate) {
    std::set<std::uint32_t> found;
    for (std::size_t e = 0; e < element_count(m.mesh); ++e)
      if (m.mesh.side_of_element[e] == side)
        for (const auto v : m.mesh.corners[e])
          if (predicate(m.mesh.vertices[index(v)]))
            found.insert(index(v));
    return found;
  };
  const auto side_of = [&m](const std::string& name) {
    for (std::uint32_t s = 0; s < m.mesh.sides.size(); ++s)
      if (m.scene.nodes[index(m.mesh.sides[s].node)].name == name)
        return SideId{s};
    return none<SideId>;
  };
  const auto at_x1 = [](const Point3& p) { return std::abs(p.x - 1) < 1e-9 && p.y < 1 + 1e-9; };
  const auto at_y1 = [](const Point3& p) { return std::abs(p.y - 1) < 1e-9; };
  EXPECT_GE(on(side_of("square"), at_x1).size(), 9U);
  EXPECT_EQ(on(side_of("square"), at_x1), on(side_of("right"), at_x1));
  EXPECT_EQ(on(side_of("square"), at_y1), on(side_of("above"), at_y1));
  EXPECT_EQ(on(side_of("right"), at_y1), on(side_of("beside"), at_y1));
}

TEST(ElementMesh, ElementsAreAsSmallAsAsked) {
  for (const double size : {0.07, 0.25, 0.9}) {
    const Meshed m = meshed(square(), {.element_size = size});
    for (const auto& corners : m.mesh.corners)
      EXPECT_LE(
          glm::distance(m.mesh.vertices[index(corners[0])], m.mesh.vertices[index(corners[1])]),
          size + 1e-6);
    EXPECT_EQ(m.mesh.element_size, size);
  }
  EXPECT_EQ(element_count(meshed(square(), {.element_size = 1e9}).mesh), 1U);
}

TEST(ElementMesh, TargetIsAboutMet) {
  for (const double target : {100.0, 5000.0}) {
    const Meshed m = meshed(half_room(), {.target_elements = target});
    // Each of 13 patches rounds both of its divisions up.
    EXPECT_GT(element_count(m.mesh), 0.9 * target);
    EXPECT_LT(element_count(m.mesh), 1.7 * target);
  }
}

TEST(ElementMesh, TrianglesThatShareEdgesAskForTwiceTheTargetAtMost) {
  // Twelve rings of a disc, each half as wide as the next: all would be divided like the widest.
  Scene scene;
  scene.materials = {diffuse(0.5)};
  scene.nodes = {{"disc"}};
  scene.position_error = 1e-9;
  constexpr int rings = 12, sectors = 24;
  for (int r = 0; r <= rings; ++r)
    for (int k = 0; k < sectors; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + 0.5 * r) / sectors;
      const double radius = 4.0 * std::pow(0.7, r);
      scene.vertices.push_back(
          {.position = {radius * std::cos(turn), 0.0, -radius * std::sin(turn)}});
    }
  const auto at = [](int r, int k) {
    return VertexId{static_cast<std::uint32_t>(r * sectors + k % sectors)};
  };
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < sectors; ++k) {
      scene.triangles.push_back({{at(r, k), at(r, k + 1), at(r + 1, k)}, MaterialId{0}, NodeId{0}});
      scene.triangles.push_back(
          {{at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)}, MaterialId{0}, NodeId{0}});
    }
  for (const double target : {1000.0, 8000.0, 30000.0}) {
    const Meshed m = meshed(scene, {.target_elements = target});
    // One element a side comes on top.
    const double asked = target + static_cast<double>(m.mesh.sides.size());
    EXPECT_LT(element_count(m.mesh), 2.0 * asked);
    EXPECT_GT(element_count(m.mesh), 0.4 * target);
  }
}

TEST(ElementMesh, TooManyElementsAreRefusedWhenAskedFor) {
  EXPECT_THROW(meshed(square(), {.element_size = 0.01, .max_elements = 5000}), UsageError);
  const Meshed m = meshed(square(), {.target_elements = 1e5, .max_elements = 5000});
  EXPECT_LE(element_count(m.mesh), 5000U);
  EXPECT_GT(element_count(m.mesh), 2000U);
}

TEST(ElementMesh, SliversDoNotMultiply) {
  Scene scene;
  add_polygon(scene, "sliver", {{0, 0, 0}, {2, 0, 0}, {2, 1e-6, 0}}, diffuse(0.5));
  const Meshed m = meshed(std::move(scene), {.element_size = 0.01});
  EXPECT_LT(element_count(m.mesh), 100U);
  for (const double area : m.mesh.area)
    EXPECT_GT(area, 0.0);
}

TEST(ElementMesh, MirrorsCarryNoElements) {
  const Meshed m = meshed(furnace(0.5, {true, false, true}), {.element_size = 0.5});
  EXPECT_EQ(m.mesh.sides.size(), 4U);
  EXPECT_EQ(element_count(m.mesh), 16U);
  const Meshed all_mirrors = meshed(furnace(0.5, {true, true, true, true, true, true}), {});
  EXPECT_EQ(element_count(all_mirrors.mesh), 0U);
}

TEST(ElementMesh, DoubleSidedHasTwoSidesThatShareNoVertex) {
  Scene scene;
  add_polygon(scene, "sheet", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
              double_sided(diffuse(0.5)));
  const Meshed m = meshed(std::move(scene), {.element_size = 0.5});
  ASSERT_EQ(m.mesh.sides.size(), 2U);
  EXPECT_NEAR(glm::dot(m.mesh.sides[0].normal, m.mesh.sides[1].normal), -1.0, 1e-12);
  EXPECT_EQ(m.mesh.vertices.size(), 18U);
}

} // namespace
} // namespace meninas::test
