#include "radiosity/field/interpolation.h"
#include "radiosity/field/vertex_fill.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

InterpolatedField field_of(const LitScene& l, const RadiositySolution& solution,
                           Interpolation method) {
  std::vector<Rgb> reflected = solution.radiosity;
  for (std::size_t e = 0; e < reflected.size(); ++e)
    reflected[e] -= l.mesh.sides[index(l.mesh.side_of_element[e])].emission;
  return interpolate(*l.light, {reflected, solution.irradiance, {}}, {}, {},
                     {.method = method, .rays = 256});
}

TEST(Interpolation, ConstantLightStaysConstant) {
  for (const auto& mirrors : {std::array<bool, 6>{}, std::array<bool, 6>{true, false, true}}) {
    const auto l = lit(furnace(0.5, mirrors), {.element_size = 0.2});
    PassOneSettings settings;
    settings.solver.tolerance = 1e-6;
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    for (const auto method : {Interpolation::average, Interpolation::gather}) {
      const InterpolatedField interpolated = field_of(*l, solution, method);
      ASSERT_EQ(interpolated.field.irradiance.size(), l->mesh.vertices.size());
      for (const auto& h : interpolated.field.irradiance)
        EXPECT_NEAR(h.g, 2.0F, 1e-4F);
    }
  }
}

/// One wall, whose elements are given the values of a function at their centres.
struct Wall {
  std::unique_ptr<LitScene> lit;
  std::vector<Rgb> values;
};

template <typename Function>
Wall wall_with(const std::vector<Point3>& corners, Function&& value) {
  Scene scene;
  add_polygon(scene, "wall", corners, diffuse(0.5));
  Wall wall{lit(std::move(scene), {.element_size = 0.1}), {}};
  const ElementMesh& mesh = wall.lit->mesh;
  for (std::size_t e = 0; e < element_count(mesh); ++e) {
    Point3 centre(0.0);
    const auto& c = mesh.corners[e];
    const std::size_t count = c[3] == c[2] ? 3 : 4;
    for (std::size_t k = 0; k < count; ++k)
      centre += mesh.vertices[index(c[k])] / double(count);
    wall.values.push_back(value(centre));
  }
  return wall;
}

// An inner vertex lies at the mean of the centres of its elements, so their mean is exact
// for what is linear. On the border the extrapolation is exact along the way inward.
TEST(Interpolation, AverageIsExactForLinearLight) {
  const auto linear = [](const Point3& x) { return Rgb(3.0 + x.x + 2.0 * x.y); };
  const std::vector<Point3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
      triangle{{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0}};
  for (const auto& corners : {square, triangle}) {
    const Wall wall = wall_with(corners, linear);
    const ElementMesh& mesh = wall.lit->mesh;
    const InterpolatedField f = interpolate(*wall.lit->light, {wall.values, wall.values, {}}, {},
                                            {}, {.method = Interpolation::average});
    int inside = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Point3& x = mesh.vertices[v];
      const bool border = corners.size() == 4
                              ? std::min({x.x, x.y, 1 - x.x, 1 - x.y}) < 1e-9
                              : std::min({x.y, x.x - 0.2 * x.y, 1 - x.x - 0.8 * x.y}) < 1e-9;
      if (border && corners.size() == 3)
        continue;
      inside += border ? 0 : 1;
      EXPECT_NEAR(f.field.irradiance[v].r, linear(x).r, 1e-5) << x.x << ' ' << x.y;
    }
    EXPECT_GE(inside, 20);
  }
}

TEST(Interpolation, NeverBelowZero) {
  const Wall wall = wall_with({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, [](const Point3& x) {
    return Rgb(x.x < 0.2 ? 0.0 : 10.0 * x.x, x.y > 0.9 ? 0.0 : 1.0, 0.0);
  });
  const InterpolatedField f = interpolate(*wall.lit->light, {wall.values, wall.values, {}}, {}, {},
                                          {.method = Interpolation::average});
  for (const auto& h : f.field.irradiance)
    for (int band = 0; band < 3; ++band)
      EXPECT_GE(h[band], 0.0F);
}

TEST(Interpolation, FieldMeetsItsVerticesAndIsContinuous) {
  const auto l = lit(half_room(), {.element_size = 0.3});
  VertexIrradiance field;
  for (const auto& x : l->mesh.vertices)
    field.irradiance.emplace_back(x.x, x.y, x.z);
  for (std::uint32_t s = 0; s < l->mesh.sides.size(); ++s) {
    const MeshSide& side = l->mesh.sides[s];
    const Patch& patch = l->surfaces.patches[index(side.patch)];
    // The field that is the position itself:
    // bilinear between vertices of a parallelogram, so exact everywhere.
    for (const Vec2 uv : {Vec2(0.0), Vec2(1.0, 0.0), Vec2(0.37, 0.11), Vec2(0.5, 0.5),
                          Vec2(0.2, 1.0), Vec2(1.0, 1.0)}) {
      if (side.triangle && uv.x + uv.y > 1.0)
        continue;
      EXPECT_LT(
          glm::distance(Point3(irradiance_at(l->mesh, field, SideId{s}, uv)), point_at(patch, uv)),
          1e-5);
    }
  }
}

// A box stands on the floor, and covers vertices.
// Just outside of it the floor is as bright as the elements there are: no dark fringe.
TEST(Interpolation, NoDarkFringeAtAThingThatStandsOnTheFloor) {
  Scene scene;
  const Material grey = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(2.0), {grey, grey, grey, diffuse(0.0, 1.0), grey, grey});
  add_box(scene, "box", {0.53, 0.0, 0.53}, {1.47, 0.05, 1.47}, grey);
  const auto l = lit(std::move(scene), {.element_size = 0.1});
  const RadiositySolution solution = solve_pass_one(l->light, {});
  const auto side = l->mesh.side_of_element[elements_of(*l, "y0")[0]];
  const Patch& patch = l->surfaces.patches[index(l->mesh.sides[index(side)].patch)];
  // At 2 cm from a box 5 cm high some light is hidden,
  // up to F = 1/2 (1 - cos(atan(5/2))) = 0.31, and the box shines back.
  const auto at = [&](double x, double z) {
    return irradiance_at(l->mesh, solution.field, side, uv_at(patch, {x, 0.0, z})).g;
  };
  const float open = at(0.2, 1.0);
  for (double z = 0.6; z < 1.4; z += 0.07)
    EXPECT_GT(at(0.51, z), 0.6F * open);
}

TEST(FillVertices, TakesTheMeanOfNeighboursForTwoRings) {
  const auto l = lit(
      [] {
        Scene scene;
        add_polygon(scene, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
        return scene;
      }(),
      {.element_size = 0.125});
  const ElementMesh& mesh = l->mesh;
  std::vector<glm::vec3> values(mesh.vertices.size(), glm::vec3(5.0F));
  std::vector<std::uint8_t> valid(values.size(), 1);
  for (std::size_t v = 0; v < values.size(); ++v)
    if (mesh.vertices[v].x > 0.3)
      valid[v] = 0;
  fill_vertices(mesh, valid, values);
  for (std::size_t v = 0; v < values.size(); ++v)
    EXPECT_EQ(values[v].r, mesh.vertices[v].x < 0.55 ? 5.0F : 0.0F);
}

} // namespace
} // namespace meninas::test
