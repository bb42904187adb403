// Scenes at the extremes through the whole of pass one, with every solver:
// finite, and as elimination in long double solves for the same form factors and sources.
#include "radiosity/relight.h"
#include "tests/radiosity/lit_system.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

constexpr double tolerance = 1e-7;

PassOneSettings pass_one_of(SolverMethod method, double element_size) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  settings.interpolation.method = Interpolation::average;
  settings.direct = {.points = 4, .max_points = 4};
  settings.solver = {method, tolerance};
  return settings;
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

class Extremes : public testing::TestWithParam<SolverMethod> {
protected:
  static void expect_the_exact_light(const Scene& scene, double element_size) {
    const PassOneSettings settings = pass_one_of(GetParam(), element_size);
    const auto l = lit(scene, settings.mesh);
    ASSERT_LT(element_count(l->mesh), 1000U); // elimination takes its time
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    EXPECT_TRUE(solution.solver.converged) << solution.solver.error_bound;
    std::vector<Rgb> reflected = solution.radiosity;
    for (std::size_t e = 0; e < reflected.size(); ++e)
      reflected[e] -= l->mesh.sides[index(l->mesh.side_of_element[e])].emission;
    const auto exact = exact_solution(system_of(*l, settings.form_factors, settings.direct));
    // Taking off emissions that are brighter by far costs digits of doubles,
    // which the tolerance does not notice.
    EXPECT_LT(true_error(exact, reflected), tolerance);
    EXPECT_TRUE(std::ranges::all_of(solution.field.irradiance, finite));
    EXPECT_TRUE(std::isfinite(solution.energy.imbalance));
  }
};

INSTANTIATE_TEST_SUITE_P(Each, Extremes, testing::ValuesIn(solver_methods), [](const auto& method) {
  std::string name = name_of(method.param);
  std::erase(name, '-');
  return name;
});

TEST_P(Extremes, ScenesOfAMicrometreAndOfAThousandKilometres) {
  for (const double scale : {1e-6, 1e6})
    expect_the_exact_light(transformed(half_room(), glm::dmat3(1.0), scale, Vec3(0.0)),
                           0.3 * scale);
}

Scene lit_room(double reflectance, double emission) {
  Scene scene;
  const Material wall = diffuse(Rgb(0.9, 0.5, 0.7) * reflectance);
  add_room(scene, Point3(0.0), Point3(1.0),
           {wall, wall, diffuse(Rgb(reflectance), Rgb(emission)), wall, wall, wall});
  return scene;
}

// A metre long and a micrometre wide:
// one stands in the room, another is the seam between two halves of a table.
TEST_P(Extremes, SliversOfAMillion) {
  Scene scene = lit_room(0.8, 1.0);
  const Material grey = double_sided(diffuse(0.5));
  constexpr double thin = 1e-6;
  add_polygon(scene, "needle", {{0.1, 0.7, 0.5}, {0.1 + thin, 0.7, 0.5}, {0.5, 0.2, 0.3}}, grey);
  add_polygon(scene, "table", {{0, 0.4, 0}, {0, 0.4, 1}, {0.5, 0.4, 1}, {0.5, 0.4, 0}}, grey);
  add_polygon(scene, "seam",
              {{0.5, 0.4, 0}, {0.5, 0.4, 1}, {0.5 + thin, 0.4, 1}, {0.5 + thin, 0.4, 0}},
              double_sided(diffuse(0.9, 2.0)));
  add_polygon(scene, "rest",
              {{0.5 + thin, 0.4, 0}, {0.5 + thin, 0.4, 1}, {0.8, 0.4, 1}, {0.8, 0.4, 0}}, grey);
  expect_the_exact_light(scene, 0.25);
}

// Elements of 1e-12 m^2 in a room of elements of nearly 1 m^2, bright and dark ones.
TEST_P(Extremes, AreasOverTwelveOrders) {
  Scene scene = lit_room(0.7, 1.0);
  for (const double side : {1e-6, 1e-4, 1e-2}) {
    const double x = 0.3 + 10.0 * side;
    add_polygon(
        scene, "tile",
        {{x, 0.3, 0.5}, {x, 0.3, 0.5 + side}, {x + side, 0.3, 0.5 + side}, {x + side, 0.3, 0.5}},
        diffuse(0.999, side < 1e-5 ? 1e6 : 0.0));
  }
  expect_the_exact_light(scene, 1.0);
}

TEST_P(Extremes, HundredsOfElementsOnOnePatchAndOneOnAnother) {
  Scene scene = lit_room(0.6, 1.0);
  add_box(scene, "dice", Point3(0.5, 0.5, 0.5), Point3(0.501, 0.501, 0.501), diffuse(0.9));
  expect_the_exact_light(scene, 0.12);
}

TEST_P(Extremes, EmissionsFromAMillionthOfAMillionthToAMillionMillions) {
  for (const double emission : {1e-12, 1e12})
    expect_the_exact_light(lit_room(0.9, emission), 0.3);
  // Both in one room.
  Scene scene = lit_room(0.9, 1e12);
  add_box(scene, "ember", Point3(0.4), Point3(0.6), diffuse(Rgb(0.0, 0.5, 1.0 - 1e-6), Rgb(1e-12)));
  expect_the_exact_light(scene, 0.3);
}

// Many files of models hold no lamp: that they are black is known without a ray.
TEST(Darkness, TakesNoRay) {
  const Scene dark = lit_room(0.8, 0.0);
  const Scene ember = lit_room(0.8, 1e-12);
  for (const auto& [cut, method] : {std::pair(MeshCut::uniform, SolverMethod::bicgstab),
                                    std::pair(MeshCut::uniform, SolverMethod::progressive),
                                    std::pair(MeshCut::hierarchical, SolverMethod::bicgstab)}) {
    PassOneSettings settings = pass_one_of(method, 0.5);
    settings.cut = cut;
    const auto l = lit(dark, settings.mesh);
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    EXPECT_EQ(solution.form_factor_rays + solution.shadow_rays, 0U);
    EXPECT_TRUE(solution.solver.converged);
    EXPECT_EQ(solution.energy.imbalance, 0.0);
    EXPECT_EQ(solution.closure.max_error, 0.0);
    ASSERT_EQ(solution.field.irradiance.size(), solution.field.mesh().vertices.size());
    EXPECT_TRUE(std::ranges::all_of(solution.field.irradiance,
                                    [](const glm::vec3& v) { return v == glm::vec3(0.0F); }));
    const auto glowing = lit(ember, settings.mesh);
    EXPECT_GT(solve_pass_one(glowing->light, settings).form_factor_rays, 0U);
  }
}

// Thousands of elements on every wall and one on each face of a die:
// too many to eliminate in long double. The residual, found in long double,
// times the bound 1 / (1 - rho) of what rows with rho < 1 make of it.
TEST(ManyElements, ThousandsOnOnePatchAndOneOnAnother) {
  constexpr double rho = 0.6;
  Scene scene = lit_room(rho, 1.0);
  add_box(scene, "dice", Point3(0.5), Point3(0.5 + 1e-3), diffuse(rho));
  const PassOneSettings settings = pass_one_of(SolverMethod::bicgstab, 1.0 / 24.0);
  const auto l = lit(scene, settings.mesh);
  ASSERT_GT(element_count(l->mesh), 3400U);
  const System system = system_of(*l, settings.form_factors, settings.direct);
  for (const SolverMethod method : solver_methods) {
    if (method == SolverMethod::direct)
      continue; // takes minutes
    const SolverResult result =
        solve(system.transport, system.source, system.reflectance, {method, tolerance});
    long double residual = 0.0L, largest = 0.0L;
    for (std::size_t i = 0; i < system.source.size(); ++i)
      for (int band = 0; band < 3; ++band) {
        long double sum = 0.0L;
        for (auto k = system.transport.row_begin[i]; k < system.transport.row_begin[i + 1]; ++k)
          sum += static_cast<long double>(system.transport.weights[k]) *
                 static_cast<long double>(result.radiosity[system.transport.columns[k]][band]);
        const long double b = static_cast<long double>(result.radiosity[i][band]);
        residual = std::max(residual,
                            std::abs(static_cast<long double>(system.source[i][band]) - b +
                                     static_cast<long double>(system.reflectance[i][band]) * sum));
        largest = std::max(largest, b);
      }
    EXPECT_TRUE(result.converged);
    EXPECT_LT(residual / (1.0L - rho), static_cast<long double>(tolerance) * largest);
  }
}

// A narrow spot lights a place between all points at which light of lamps is known: what walls reflect of it is
// there, by rays, and belongs to some lamp. A page with dimmers would be black otherwise.
TEST(LampsApart, LightOfWhichNoLampIsKnownIsNotLost) {
  VertexIrradiance field;
  field.irradiance = {glm::vec3(1e-9F, 0.0F, 3e-10F), glm::vec3(2e-9F, 0.0F, 1e-10F)};
  field.indirect = {field.irradiance[0], glm::vec3(0.0F)};
  const std::vector<glm::vec3> nothing(2, glm::vec3(0.0F));
  field.by_lamp.assign(2, {nothing, nothing});
  field.by_lamp[0].direct[1].b = 1.0F; // of blue something is known
  add_up_by_vertex(field);
  for (std::size_t v = 0; v < 2; ++v)
    for (int band = 0; band < 3; ++band) {
      float sum = 0.0F;
      for (const VertexLightOfLamp& lamp : field.by_lamp)
        sum += lamp.direct[v][band] + lamp.indirect[v][band];
      EXPECT_FLOAT_EQ(sum, field.irradiance[v][band]) << v << ' ' << band;
    }
  EXPECT_FLOAT_EQ(field.by_lamp[0].indirect[0].r, 5e-10F) << "as much of one as of the other";
  EXPECT_EQ(field.by_lamp[1].indirect[0].b, 0.0F) << "it is all of the lamp that is known";
}

} // namespace
} // namespace meninas::test
