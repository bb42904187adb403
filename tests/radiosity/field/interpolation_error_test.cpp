// Where a field bends, and what finer elements there bring.
#include "radiosity/field/interpolation_error.h"
#include "radiosity/field/gathered_field.h"
#include "radiosity/light/point_irradiance.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace meninas::test {
namespace {

constexpr double size = 0.1;

/// One square metre that reflects half, in elements of 0.1 m.
const LitScene& wall() {
  static const auto l = [] {
    Scene scene;
    add_polygon(scene, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
    return lit(std::move(scene), {.element_size = size});
  }();
  return *l;
}

std::vector<std::uint8_t> bent(const std::function<double(const Point3&)>& f, double x) {
  std::vector<glm::vec3> values;
  for (const Point3& vertex : wall().mesh.vertices)
    values.emplace_back(f(vertex));
  return bent_by_more(
      interpolation_error(wall().mesh, values, {.area = size * size, .radiosity = 1.0}), x);
}

TEST(Bends, AreWhereLightBends) {
  // The slope changes by 8 from one edge to the next: |f''| = 8 / size,
  // and linear interpolation over an element beside it is off by size, of which half is reflected.
  const auto kink = [](const Point3& x) { return 1.0 + 8.0 * std::max(x.x - 0.5, 0.0); };
  const double off = 0.5 * size;
  const auto above = bent(kink, 0.99 * off), below = bent(kink, 1.01 * off);
  for (std::size_t e = 0; e < above.size(); ++e) {
    const double x = centre_of(wall().mesh, static_cast<ElementId>(e)).x;
    EXPECT_EQ(above[e], std::abs(x - 0.5) < size ? 1 : 0) << x;
    EXPECT_EQ(below[e], 0) << x;
  }
}

TEST(Bends, AreNotSlopes) {
  const auto bent_by_slope =
      bent([](const Point3& x) { return 1.0 + 5.0 * x.x + 3.0 * x.y; }, 1e-4);
  EXPECT_EQ(std::ranges::count(bent_by_slope, 1), 0);
}

TEST(Bends, OfWhatIsOrdinaryDoNotCount) {
  // Checkered noise of 2 % bends by 4 differences of 2 % over a square of edges,
  // in every vertex alike.
  const auto noise = [](const Point3& x) {
    return 1.0 + 0.02 * ((std::lround(x.x / size) + std::lround(x.y / size)) % 2 == 0 ? 1.0 : -1.0);
  };
  const auto by_noise = bent(noise, 1e-6);
  EXPECT_EQ(std::ranges::count(by_noise, 1), 0);
}

// Vertices that take means have no noise and no bend. Where a lamp has most of all vertices, the noise of
// the others is still what is ordinary among these.
TEST(Bends, OfNoiseDoNotCountBesideLamps) {
  std::vector<glm::vec3> values;
  std::vector<std::uint8_t> on_lamps;
  for (const Point3& x : wall().mesh.vertices) {
    const bool is_lamp = x.x < 0.65;
    const bool even = (std::lround(x.x / size) + std::lround(x.y / size)) % 2 == 0;
    values.emplace_back(is_lamp ? 1.0 : 1.0 + (even ? 0.02 : -0.02));
    on_lamps.push_back(is_lamp ? 1 : 0);
  }
  const BendScale scale{.area = size * size, .radiosity = 1.0};
  // In the middle of what is noisy, away from the edge between both.
  const auto noisy_bends = [&](std::span<const std::uint8_t> lamps) {
    const auto bends = interpolation_error(wall().mesh, values, scale, of_source, lamps);
    double most = 0.0;
    for (std::size_t e = 0; e < bends.size(); ++e)
      if (centre_of(wall().mesh, static_cast<ElementId>(e)).x > 0.8)
        most = std::max(most, bends[e]);
    return most;
  };
  const double off = 0.5 * 4.0 * 0.02 / 8.0; // of which half is reflected
  EXPECT_NEAR(noisy_bends({}), off, 1e-5);
  EXPECT_LT(noisy_bends(on_lamps), 0.05 * off); // H is 0.98 and 1.02 by turns
}

// Twice as bent as most of the wall: for rays that is within what noise may be,
// direct light stands out.
TEST(Bends, OfTheSourceStandOutSooner) {
  const auto f = [](const Point3& x) {
    return x.x * x.x + std::pow(std::max(x.x - 0.7, 0.0), 2.0);
  };
  std::vector<glm::vec3> values;
  for (const Point3& vertex : wall().mesh.vertices)
    values.emplace_back(10.0 + f(vertex));
  const BendScale scale{.area = size * size, .radiosity = 1.0};
  const double x = 0.2 * 0.5 * 2.0 * size * size / 8.0; // a fifth of the larger part's excess
  const auto of_rays = bent_by_more(interpolation_error(wall().mesh, values, scale), x),
             of_light = bent_by_more(interpolation_error(wall().mesh, values, scale, of_source), x);
  EXPECT_EQ(std::ranges::count(of_rays, 1), 0);
  for (std::size_t e = 0; e < of_light.size(); ++e) {
    const double at = centre_of(wall().mesh, static_cast<ElementId>(e)).x;
    EXPECT_EQ(of_light[e], at > 0.6 ? 1 : 0) << at; // those at 0.65 have corners where it begins
  }
}

TEST(Bends, CountByTheAreaTheyHave) {
  const auto kink = [](const Point3& x) { return 1.0 + 8.0 * std::max(x.x - 0.5, 0.0); };
  std::vector<glm::vec3> values;
  for (const Point3& vertex : wall().mesh.vertices)
    values.emplace_back(kink(vertex));
  const double x = 0.99 * 0.5 * size;
  const auto among_large = bent_by_more(
      interpolation_error(wall().mesh, values, {.area = 4.0 * size * size, .radiosity = 1.0}), x);
  EXPECT_EQ(std::ranges::count(among_large, 1), 0);
}

// A surface of one element has no second difference. From even light at one end a parabola
// rises by 0.8 to the other: in the middle it is 0.2 below the line, of which half is reflected.
TEST(Bends, MayBeWhereOneElementIsAll) {
  const auto bends = [](double element_size) {
    Scene scene;
    add_polygon(scene, "panel", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
    const auto l = lit(std::move(scene), {.element_size = element_size});
    std::vector<glm::vec3> values;
    for (const Point3& vertex : l->mesh.vertices)
      values.emplace_back(1.0 + 0.8 * vertex.x * vertex.x);
    return edge_difference_error(l->mesh, values, {.area = 1.0, .radiosity = 2.0});
  };
  const std::vector<double> of_one = bends(1.0);
  ASSERT_EQ(of_one.size(), 1U);
  EXPECT_NEAR(of_one.front(), 0.5 * 0.2 / 2.0, 1e-7); // values are floats
  for (const double bend : bends(0.5))
    EXPECT_EQ(bend, 0.0);
}

constexpr double height = 0.4;

/// A box whose side a lamp lights stands on a floor.
Scene lit_box() {
  Scene scene;
  add_polygon(scene, "floor", {{0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}}, diffuse(0.2));
  add_box(scene, "box", {0.75, 0.0, 0.8}, {1.5, height, 2.2}, diffuse(0.8));
  add_polygon(scene, "lamp", {{-3, 0, 0}, {-3, 3, 0}, {-3, 3, 3}, {-3, 0, 3}}, diffuse(0.0, 40.0));
  return scene;
}

/// The field within 0.3 m of the foot, against the light gathered there.
double off_at_the_foot(double bend, std::size_t& elements) {
  const auto l = lit(lit_box(), {.element_size = 0.3});
  PassOneSettings settings;
  settings.interpolation.rays = settings.form_factors.rays = 1024;
  settings.interpolation.bend = bend;
  const RadiositySolution solution = solve_pass_one(l->light, settings);
  const LightScene& of_field = *solution.field.scene;
  elements = element_count(of_field.mesh);
  const SideId floor = l->mesh.side_of_element[elements_of(*l, "floor")[0]];
  const MeshSide& side = l->mesh.sides[index(floor)];
  const Patch& patch = l->surfaces.patches[index(side.patch)];
  std::vector<Rgb> reflected = solution.radiosity;
  for (std::size_t e = 0; e < reflected.size(); ++e)
    reflected[e] -= l->mesh.emission[e];
  const PointGathering gathering(*l->light, reflected, settings.form_factors, settings.direct,
                                 {.rays = 1024});
  PointWorkspace work;
  double sum = 0.0;
  constexpr int points = 60;
  for (int k = 0; k < points; ++k) {
    const Point3 x{0.75 - 0.3 * (k + 0.5) / points, 0.0, 1.47};
    const Vec2 uv = uv_at(patch, x);
    const double here = double{
        value_in(of_field.mesh, solution.field.indirect, locate(of_field.mesh, floor, uv)).g};
    const double truth =
        indirect_light_at(gathering, {x, side.normal, side.plane_class, side.tangent}, 7, work)
            .indirect()
            .total.g;
    sum += std::pow(here / truth - 1.0, 2.0);
  }
  return std::sqrt(sum / points);
}

TEST(Bends, DividedShowTheFootOfALitWall) {
  std::size_t elements = 0, finer = 0;
  const double coarse = off_at_the_foot(0.0, elements);
  EXPECT_GT(coarse, 0.05) << "or else nothing is tested";
  // Elements of several sizes meet at the wall, elsewhere for each X.
  for (const double x : {0.05, 0.02, 0.01, 0.005}) {
    EXPECT_LT(off_at_the_foot(x, finer), coarse / 3.0)
        << "what is left is noise of 1,024 rays; " << x;
    EXPECT_GT(finer, elements);
    EXPECT_LT(finer, (x == 0.05 ? 3 : 5) * elements);
  }
}

} // namespace
} // namespace meninas::test
