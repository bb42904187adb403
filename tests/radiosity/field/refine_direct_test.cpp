// Elements divided where direct light bends: shadows are nearer to what they are,
// for few vertices, and what is smooth stays as it was.
#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/mesh/subdivision.h"
#include "radiosity/field/refine_direct.h"
#include "radiosity/field/vertex_places.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

PassOneSettings by_nodes(double element_size, double shadow_bend) {
  PassOneSettings settings;
  settings.mesh.element_size = element_size;
  settings.form_factors.rays = settings.interpolation.rays = 128;
  settings.cut = MeshCut::hierarchical;
  settings.interpolation.shadow_bend = shadow_bend;
  return settings;
}

/// A room whose floor a lamp lights, without anything between.
Scene empty_room() {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  add_polygon(scene, "lamp", {{0.4, 0.9, 0.4}, {0.6, 0.9, 0.4}, {0.6, 0.9, 0.6}, {0.4, 0.9, 0.6}},
              diffuse(0.0, 10.0));
  return scene;
}

/// A plate in it hides half of the lamp from some of the floor.
Scene room_with_plate() {
  Scene scene = empty_room();
  add_polygon(scene, "plate", {{0.1, 0.4, 0.1}, {0.1, 0.4, 0.9}, {0.5, 0.4, 0.9}, {0.5, 0.4, 0.1}},
              double_sided(diffuse(0.5)));
  return scene;
}

/// A place on a side of the mesh that was solved.
struct Place {
  SideId side;
  Vec2 uv;
};

/// The middles of all elements of nodes of a name.
std::vector<Place> middles_of(const LitScene& l, const std::string& node) {
  std::vector<Place> places;
  for (const std::size_t e : elements_of(l, node)) {
    const SideId side = l.mesh.side_of_element[e];
    const Patch& patch = l.surfaces.patches[index(l.mesh.sides[index(side)].patch)];
    places.push_back({side, uv_at(patch, centre_of(l.mesh, static_cast<ElementId>(e)))});
  }
  return places;
}

/// Direct light there: by many shadow rays, and as the field has it.
double exactly(const LitScene& l, const Place& place, DirectWorkspace& work) {
  const MeshSide& side = l.mesh.sides[index(place.side)];
  const Patch& patch = l.surfaces.patches[index(side.patch)];
  const Receiver point{point_at(patch, place.uv), side.normal, side.plane_class, side.tangent};
  return direct_irradiance(*l.light, point,
                           {.shadow_rays = 256,
                            .penumbra_rays = 4096,
                            .penumbra_samples = PenumbraSamples::everywhere},
                           0, work)
      .total.g;
}

double by_field(const RadiositySolution& solution, const Place& place) {
  const ElementMesh& mesh = solution.field.mesh();
  return double{irradiance_at(mesh, solution.field, place.side, place.uv).g} -
         double{value_in(mesh, solution.field.indirect, locate(mesh, place.side, place.uv)).g};
}

std::vector<double> exactly(const LitScene& l, const std::vector<Place>& places) {
  DirectWorkspace work;
  std::vector<double> light;
  for (const Place& place : places)
    light.push_back(exactly(l, place, work));
  return light;
}

/// The mean of the squares of what the field is off by where light arrives, over that of what does.
double error_of(const RadiositySolution& solution, const std::vector<Place>& places,
                const std::vector<double>& expected) {
  double squares = 0.0, all = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (expected[k] > 0.0) {
      squares += std::pow(by_field(solution, places[k]) - expected[k], 2.0);
      all += expected[k] * expected[k];
    }
  return squares / all;
}

/// Of elements of 0.25 m that are not divided, and with a bound of x.
std::array<double, 2> errors_without_and_with(const LitScene& l, const std::vector<Place>& places,
                                              double x) {
  const std::vector<double> expected = exactly(l, places);
  const auto error = [&](double bound) {
    return error_of(solve_pass_one(l.light, by_nodes(0.25, bound)), places, expected);
  };
  return {error(0.0), error(x)};
}

// In the middle of elements interpolation is off by e = h^2 D'' / 8. Elements that are off by most
// are divided up to three times, of those that are less some: of the squared error a third is left
// at the most, for less than two thirds as many elements more.
TEST(ShadowEdges, AreNearerToWhatTheyAre) {
  const auto l = lit(room_with_plate(), {.element_size = 1.0 / 16.0});
  const std::vector<Place> places = middles_of(*l, "y0");
  const RadiositySolution even = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.0)),
                          finer = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.02));
  ASSERT_NE(finer.field.scene, l->light);
  EXPECT_EQ(even.field.scene, l->light);
  const std::size_t before = element_count(l->mesh),
                    now = element_count(finer.field.mesh());
  EXPECT_LT(now - before, 2 * before / 3);
  const std::vector<double> expected = exactly(*l, places);
  EXPECT_LT(error_of(finer, places, expected), error_of(even, places, expected) / 3.0);
}

// Nothing is gathered for them: indirect light is the same everywhere.
TEST(ShadowEdges, LeaveTheRestAsItWas) {
  const auto l = lit(room_with_plate(), {.element_size = 1.0 / 16.0});
  const RadiositySolution even = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.0)),
                          finer = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.02));
  const ElementMesh& mesh = finer.field.mesh();
  EXPECT_EQ(even.radiosity, finer.radiosity);
  EXPECT_LE(finer.form_factor_rays, even.form_factor_rays + 32 * mesh.vertices.size())
      << "32 of each that is dark tell whether it is covered";
  for (const Place& place : middles_of(*l, "y0")) {
    const float before =
        value_in(l->mesh, even.field.indirect, locate(l->mesh, place.side, place.uv)).g;
    EXPECT_NEAR(value_in(mesh, finer.field.indirect, locate(mesh, place.side, place.uv)).g, before,
                1e-5F * before);
  }
}

// Vertices that hang are where the edges of their larger neighbours are.
TEST(ShadowEdges, HaveNoCracks) {
  const auto l = lit(room_with_plate(), {.element_size = 1.0 / 16.0});
  const RadiositySolution solution = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.02));
  const ElementMesh& mesh = solution.field.mesh();
  EXPECT_GT(mesh.hanging.size(), 10);
  for (const auto* values : {&solution.field.irradiance, &solution.field.indirect})
    for (const HangingVertex& hanging : mesh.hanging)
      EXPECT_EQ((*values)[index(hanging.vertex)],
                0.5F * ((*values)[index(hanging.end_a)] + (*values)[index(hanging.end_b)]));
}

// Where everything bends by more than a tiny bound there are no more than there may be,
// and those that follow their neighbours, a third as many at the most.
TEST(ShadowEdges, AreNoMoreThanTheyMayBe) {
  Scene scene = room_with_plate();
  PunctualLight point;
  point.position = {0.8, 0.6, 0.3};
  point.intensity = Rgb(10.0);
  scene.lights = {point};
  const auto l = lit(scene, {.element_size = 1.0 / 32.0});
  const RadiositySolution solution = solve_pass_one(l->light, by_nodes(1.0 / 32.0, 1e-9));
  const double solved = double(element_count(l->mesh)),
               now = double(element_count(solution.field.mesh())),
               more = double(max_at_shadows(element_count(l->mesh)));
  EXPECT_GT(now, solved + more / 2.0);
  EXPECT_LT(now, solved + 4.0 / 3.0 * more);
  EXPECT_EQ(max_at_shadows(100'000), 100'000U);
}

// On large elements smooth light bends as much as edges do, at most vertices alike: noise it is not.
// Middles of elements of 0.25 m become vertices; half the size alone takes a sixteenth.
TEST(ShadowEdges, AreNotAllThatIsDivided) {
  const auto l = lit(empty_room(), {.element_size = 0.25});
  const std::vector<Place> places = middles_of(*l, "y0");
  const auto [even, finer] = errors_without_and_with(*l, places, 0.01);
  EXPECT_GT(even, 1e-3);
  EXPECT_LT(finer, even / 16.0);
}

/// A table of one element, a third of it in the shadow of a plate.
Scene room_with_table() {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  add_polygon(scene, "lamp",
              {{0.48, 0.9, 0.48}, {0.52, 0.9, 0.48}, {0.52, 0.9, 0.52}, {0.48, 0.9, 0.52}},
              diffuse(0.0, 400.0));
  add_polygon(scene, "plate",
              {{0.1, 0.5, 0.1}, {0.1, 0.5, 0.9}, {0.48, 0.5, 0.9}, {0.48, 0.5, 0.1}},
              double_sided(diffuse(0.5)));
  add_polygon(scene, "table", {{0.4, 0.3, 0.4}, {0.4, 0.3, 0.6}, {0.6, 0.3, 0.6}, {0.6, 0.3, 0.4}},
              diffuse(0.5));
  return scene;
}

// There are no second differences, and all of the table has the wrong light. Three divisions leave
// the strip beside the edge, an eighth; a quarter leaves room for where in it the edge is.
TEST(ShadowEdges, AreFoundWhereOneElementIsAll) {
  const auto l = lit(room_with_table(), {.element_size = 0.25});
  ASSERT_EQ(elements_of(*l, "table").size(), 1U);
  const SideId table = l->mesh.side_of_element[elements_of(*l, "table").front()];
  std::vector<Place> places;
  for (double u = 1.0 / 64.0; u < 1.0; u += 1.0 / 32.0)
    for (double v = 1.0 / 64.0; v < 1.0; v += 1.0 / 32.0)
      places.push_back({table, Vec2(u, v)});
  const auto [even, finer] = errors_without_and_with(*l, places, 0.02);
  EXPECT_GT(even, 0.05);
  EXPECT_LT(finer, even / 4.0);
}

/// A tube of small facets, which a lamp lights from one side.
Scene room_with_tube(int sides) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  add_polygon(scene, "lamp", {{0.1, 0.4, 0.4}, {0.1, 0.6, 0.4}, {0.1, 0.6, 0.6}, {0.1, 0.4, 0.6}},
              diffuse(0.0, 100.0));
  constexpr int rows = 4;
  const auto at = [sides](int side, int row) {
    const double turn = 2.0 * std::numbers::pi * (side % sides) / sides;
    return Point3(0.6 + 0.05 * std::cos(turn), 0.45 + 0.025 * row, 0.5 - 0.05 * std::sin(turn));
  };
  for (int k = 0; k < sides; ++k)
    for (int row = 0; row < rows; ++row)
      add_polygon(scene, "tube", {at(k, row), at(k + 1, row), at(k + 1, row + 1), at(k, row + 1)},
                  wall);
  return scene;
}

// Corners of facets have the mean of those around them, which differs from one to the next
// as the curve turns: that is no edge on a facet.
TEST(ShadowEdges, AreNotBetweenTheMeansOfFacets) {
  for (const int sides : {12, 36}) {
    const auto l = lit(room_with_tube(sides), {.element_size = 0.25});
    ASSERT_FALSE(facets_around(*l->light).elements.empty());
    const std::vector<std::size_t> tube = elements_of(*l, "tube");
    const RadiositySolution solution = solve_pass_one(l->light, by_nodes(0.25, 0.02));
    const ElementMesh& mesh = solution.field.mesh();
    std::size_t now = 0;
    for (const SideId side : mesh.side_of_element)
      now += std::ranges::any_of(tube,
                                 [&](std::size_t e) { return l->mesh.side_of_element[e] == side; });
    EXPECT_EQ(now, tube.size()) << sides;
  }
}

/// Direct light at the corners of the tube's facets, over the mean of all:
/// how far at the most those at one place differ.
double unevenness_at_places(const LitScene& l, const RadiositySolution& solution) {
  const ElementMesh& mesh = solution.field.mesh();
  std::vector<std::pair<Point3, double>> corners;
  double sum = 0.0;
  for (const std::size_t e : elements_of(l, "tube"))
    for (const ElementVertexId v : l.mesh.corners[e]) {
      const Point3& x = l.mesh.vertices[index(v)];
      if (x.y < 0.46 || x.y > 0.54)
        continue; // fewer than three facets meet at the rims
      const SideId side = l.mesh.side_of_element[e];
      const Patch& patch = l.surfaces.patches[index(l.mesh.sides[index(side)].patch)];
      const auto at = locate(mesh, side, uv_at(patch, x));
      corners.emplace_back(x, double{value_in(mesh, solution.field.irradiance, at).g} -
                                  double{value_in(mesh, solution.field.indirect, at).g});
      sum += corners.back().second;
    }
  double most = 0.0;
  for (const auto& [x, light] : corners)
    for (const auto& [y, other] : corners)
      if (glm::distance(x, y) < 1e-6)
        most = std::max(most, std::abs(light - other));
  return most * double(corners.size()) / sum;
}

// Facets that turn by 10 degrees share their light at every place; those of a tube of twelve,
// where the light bends, have their own: from one in grazing light to the next it differs by
// sin 30 degrees of what the brightest has, and the mean is a third of that.
TEST(ShadowEdges, OfFewFacetsAreBetweenThem) {
  const auto fine = lit(room_with_tube(36), {.element_size = 0.25}),
             coarse = lit(room_with_tube(12), {.element_size = 0.25});
  EXPECT_LT(unevenness_at_places(*fine, solve_pass_one(fine->light, by_nodes(0.25, 0.02))), 1e-5);
  EXPECT_LT(unevenness_at_places(*coarse, solve_pass_one(coarse->light, by_nodes(0.25, 0.0))),
            1e-5);
  EXPECT_GT(unevenness_at_places(*coarse, solve_pass_one(coarse->light, by_nodes(0.25, 0.02))),
            0.5);
}

// A plate takes the light from the lower part of a fine tube, to the middle of facets. Three
// divisions leave the strip beside the edge; half of the error leaves room for what means hide.
TEST(ShadowEdges, AreFoundOnFacets) {
  Scene scene = room_with_tube(36);
  add_polygon(scene, "plate",
              {{0.53, 0.0, 0.3}, {0.53, 0.4875, 0.3}, {0.53, 0.4875, 0.7}, {0.53, 0.0, 0.7}},
              double_sided(diffuse(0.5)));
  const auto l = lit(scene, {.element_size = 0.25});
  std::vector<Place> places;
  for (const std::size_t e : elements_of(*l, "tube"))
    for (double u = 0.1; u < 1.0; u += 0.2)
      for (double v = 0.1; v < 1.0; v += 0.2)
        places.push_back({l->mesh.side_of_element[e], Vec2(u, v)});
  const auto [even, finer] = errors_without_and_with(*l, places, 0.02);
  EXPECT_LT(finer, even / 2.0);
}

/// A lamp over a box that is so far above the floor, not along the edges of elements.
Scene room_with_box(double gap) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  add_polygon(scene, "lamp", {{0.1, 0.9, 0.1}, {0.9, 0.9, 0.1}, {0.9, 0.9, 0.9}, {0.1, 0.9, 0.9}},
              diffuse(0.0, 1.0));
  add_box(scene, "box", {0.37, gap, 0.41}, {0.63, gap + 0.3, 0.66}, wall);
  return scene;
}

/// Places on the floor beside the foot of that box.
std::vector<Place> beside_foot(const LitScene& l) {
  const Place floor = middles_of(l, "y0").front();
  const MeshSide& side = l.mesh.sides[index(floor.side)];
  const Patch& patch = l.surfaces.patches[index(side.patch)];
  std::vector<Place> places;
  for (const auto& [from, to] : {std::pair(Point3(0.37, 0.0, 0.40), Point3(0.63, 0.0, 0.40)),
                                 std::pair(Point3(0.64, 0.0, 0.41), Point3(0.64, 0.0, 0.66)),
                                 std::pair(Point3(0.63, 0.0, 0.67), Point3(0.37, 0.0, 0.67)),
                                 std::pair(Point3(0.36, 0.0, 0.66), Point3(0.36, 0.0, 0.41))})
    for (double t = 0.05; t < 1.0; t += 0.1)
      places.push_back({floor.side, uv_at(patch, from + t * (to - from))});
  return places;
}

// Vertices under a box are dark: what lies beside it takes nothing of that.
// Interpolated it is within a quarter of what arrives.
TEST(ShadowEdges, AreCleanWhereThingsStand) {
  const auto l = lit(room_with_box(0.0), {.element_size = 1.0 / 16.0});
  const RadiositySolution solution = solve_pass_one(l->light, by_nodes(1.0 / 16.0, 0.005));
  ASSERT_NE(solution.field.scene, l->light);
  DirectWorkspace work;
  for (const Place& place : beside_foot(*l)) {
    const double there = exactly(*l, place, work);
    EXPECT_NEAR(by_field(solution, place), there, 0.25 * there);
  }
  for (const glm::vec3& value : solution.field.irradiance)
    EXPECT_TRUE(value.g >= 0.0F && std::isfinite(value.g));
}

// Under a box that hardly leaves the floor, some vertices of large elements are covered and some of
// small ones see a little of the dark: nowhere beside it is that darker than it was, and is.
TEST(ShadowEdges, AreNotDarkerWhereThingsHover) {
  const auto l = lit(room_with_box(0.004), {.element_size = 1.0 / 11.0});
  const RadiositySolution even = solve_pass_one(l->light, by_nodes(1.0 / 11.0, 0.0)),
                          finer = solve_pass_one(l->light, by_nodes(1.0 / 11.0, 0.02));
  ASSERT_NE(finer.field.scene, l->light);
  DirectWorkspace work;
  for (const Place& place : beside_foot(*l)) {
    const double there = exactly(*l, place, work);
    EXPECT_GT(by_field(finer, place), 0.9 * std::min(there, by_field(even, place)));
  }
}

// The method of images: what a mirror throws has edges too, which are divided,
// and is what arrives in the doubled room.
TEST(ShadowEdges, OfTheMirrorRoomAreThoseOfTheDoubledOne) {
  const Scene half = half_room_with_small_mirror();
  const auto a = lit(half, {.element_size = 0.125}),
             b = lit(doubled(half), {.element_size = 0.125});
  const RadiositySolution even = solve_pass_one(a->light, by_nodes(0.125, 0.0)),
                          finer = solve_pass_one(a->light, by_nodes(0.125, 0.01));
  double before = 0.0, now = 0.0;
  for (const std::string wall : {"x1", "y0", "z0"}) {
    const std::vector<Place> places = middles_of(*a, wall);
    const std::vector<double> expected = exactly(*b, middles_of(*b, wall));
    ASSERT_EQ(places.size(), expected.size());
    before += error_of(even, places, expected);
    now += error_of(finer, places, expected);
    EXPECT_LT(error_of(finer, places, expected), std::pow(0.02, 2.0)) << wall;
  }
  EXPECT_LT(now, before / 2.0);
}

TEST(ShadowEdges, AreTheSameBitsForAnyNumberOfThreads) {
  const auto l = lit(room_with_plate(), {.element_size = 1.0 / 12.0});
  std::vector<RadiositySolution> runs;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    runs.push_back(solve_pass_one(l->light, by_nodes(1.0 / 12.0, 0.01)));
  }
  for (const RadiositySolution& run : runs) {
    EXPECT_EQ(run.field.irradiance, runs[0].field.irradiance);
    EXPECT_EQ(run.field.indirect, runs[0].field.indirect);
    EXPECT_EQ(run.shadow_rays, runs[0].shadow_rays);
  }
}

} // namespace
} // namespace meninas::test
