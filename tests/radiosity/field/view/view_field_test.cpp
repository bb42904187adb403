#include "form_factors/point_form_factor.h"
#include "radiosity/field/view/view_field.h"
#include "radiosity/mesh/subdivision.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

/// A floor of 4 m by 4 m about the origin, which alone scatters, y up.
void add_floor(Scene& scene) {
  add_polygon(scene, "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}, diffuse(0.5));
}

std::vector<Point3> lamp_over_the_floor() {
  return {{-0.5, 2, -0.5}, {0.5, 2, -0.5}, {0.5, 2, 0.5}, {-0.5, 2, 0.5}};
}

PunctualLight sun_from_above() {
  PunctualLight sun{.name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(1.0)};
  sun.direction = {0, -1, 0};
  return sun;
}

/// A blade over the floor whose slanting edge throws a sharp shadow.
Scene floor_half_in_the_sun() {
  Scene scene;
  add_floor(scene);
  scene.lights = {sun_from_above()};
  add_polygon(scene, "blade", {{-3, 1, -3}, {-3, 1, 3}, {0.1, 1, 3}, {0.3, 1, -3}},
              double_sided(diffuse(0.0)));
  return scene;
}

struct SolvedFloor {
  std::unique_ptr<LitScene> scene;
  RadiositySolution solution;
  SideId side = none<SideId>;

  explicit SolvedFloor(Scene of, double element_size)
      : scene(lit(std::move(of), {.element_size = element_size})) {
    PassOneSettings settings;
    settings.form_factors.rays = settings.interpolation.rays = 64;
    solution = solve_pass_one(scene->light, settings);
    side = scene->mesh.side_of_element[elements_of(*scene, "floor").front()];
  }

  const IrradianceField& field() const { return solution.field; }

  /// (u, v) of a place on the floor.
  Vec2 uv(double x, double z) const {
    const MeshSide& of = field().mesh().sides[index(side)];
    return uv_at(scene->surfaces.patches[index(of.patch)], Point3(x, 0, z));
  }

  /// A square of the floor about a place, seen from straight above, `across` by `across` pixels.
  std::vector<SeenPoint> square(const Point3& centre, double half, int across) const {
    std::vector<SeenPoint> seen;
    const double width = 2.0 * half / across;
    for (int j = 0; j <= across; ++j)
      for (int i = 0; i <= across; ++i) {
        const ElementPoint at = locate(
            field().mesh(), side, uv(centre.x - half + i * width, centre.z - half + j * width));
        seen.push_back({index(at.element), glm::vec2(at.st), static_cast<float>(width)});
      }
    return seen;
  }
};

double irradiance(const SolvedFloor& floor, const IrradianceField& field, double x, double z) {
  const Landing at = land(field.lookup(), index(floor.side), glm::vec2(floor.uv(x, z)));
  const ElementCorners& corners = field.corners()[at.element];
  const auto h = [&](std::size_t c) { return double{field.irradiance[index(corners[c])].g}; };
  const double s = double{at.st.x}, t = double{at.st.y};
  return (1.0 - t) * ((1.0 - s) * h(0) + s * h(1)) + t * ((1.0 - s) * h(3) + s * h(2));
}

TEST(ViewField, IsTheClosedFormWithinItsTolerance) {
  Scene scene;
  add_floor(scene);
  add_polygon(scene, "lamp", lamp_over_the_floor(), diffuse(0.0, 10.0));
  const SolvedFloor floor(std::move(scene), 2.0);
  const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, 1.5, 64), 1.0, {});
  Random random(1);
  double coarse = 0.0, fine = 0.0;
  for (int n = 0; n < 500; ++n) {
    const double x = random.between(-1.5, 1.5), z = random.between(-1.5, 1.5);
    const double exact = 10.0 * point_form_factor({x, 0, z}, {0, 1, 0}, lamp_over_the_floor());
    coarse = std::max(coarse, std::abs(irradiance(floor, floor.field(), x, z) / exact - 1.0));
    fine = std::max(fine, std::abs(irradiance(floor, view.field, x, z) / exact - 1.0));
  }
  EXPECT_GT(coarse, 0.1) << "or else nothing is tested";
  EXPECT_LT(fine, 0.02) << "the tolerance";
}

// Whoever has moved on does not wait for it: it is asked every few vertices.
TEST(ViewField, EndsWhereItsProgressThrows) {
  struct Over {};
  Scene scene;
  add_floor(scene);
  add_polygon(scene, "lamp", lamp_over_the_floor(), diffuse(0.0, 10.0));
  const SolvedFloor floor(std::move(scene), 2.0);
  std::atomic<std::size_t> told{0};
  const ViewField whole = view_field(floor.field(), floor.square({0, 0, 0}, 1.5, 64), 1.0, {}, [&](std::string_view, double) { ++told; });
  EXPECT_GE(16 * told.load() + 64, whole.field.irradiance.size() - floor.field().irradiance.size());
  EXPECT_THROW(view_field(floor.field(), floor.square({0, 0, 0}, 1.5, 64), 1.0, {}, [](std::string_view, double) { throw Over{}; }), Over);
}

/// The same by a lamp of 1 m, whose light is curved everywhere.
Scene floor_half_under_a_lamp() {
  Scene scene = floor_half_in_the_sun();
  scene.lights.clear();
  add_polygon(scene, "lamp", lamp_over_the_floor(), diffuse(0.0, 10.0));
  return scene;
}

/// From one side of any line of the lattice, down to 1/64 m, to the other nothing jumps: a step of 1e-6 m
/// changes light by no more than 1e-4 of what the lamp sends.
void expect_no_cracks(const SolvedFloor& floor, const IrradianceField& field) {
  Random random(2);
  for (int n = 0; n < 10'000; ++n) {
    const double edge = std::round(random.between(-110.0, 110.0)) / 64.0,
                 at = random.between(-1.7, 1.7);
    EXPECT_NEAR(irradiance(floor, field, edge - 5e-7, at),
                irradiance(floor, field, edge + 5e-7, at), 1e-4)
        << edge << " " << at;
    EXPECT_NEAR(irradiance(floor, field, at, edge - 5e-7),
                irradiance(floor, field, at, edge + 5e-7), 1e-4)
        << at << " " << edge;
  }
}

TEST(ViewField, HasNoCracksBesideSmallerCells) {
  const SolvedFloor floor(floor_half_under_a_lamp(), 1.0);
  const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, 1.9, 128), 1.0, {});
  expect_no_cracks(floor, view.field);
}

// The shadow of a rod a pixel and a half wide is dark along all of its length: sun finds it by the points
// that are seen, and what has been found is followed.
TEST(ViewField, ThinShadowsAreNotBroken) {
  constexpr double half = 1.5, pixel = 2.0 * half / 100, rod = 0.75 * pixel;
  Scene scene;
  add_floor(scene);
  scene.lights = {sun_from_above()};
  add_polygon(scene, "rod", {{-rod, 1, -3}, {-rod + 0.7, 1, 3}, {rod + 0.7, 1, 3}, {rod, 1, -3}},
              double_sided(diffuse(0.0)));
  const SolvedFloor floor(std::move(scene), 1.0);
  const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, half, 100), 1.0, {});
  for (int k = -50; k <= 50; ++k) {
    const double z = 0.028 * k, x = 0.7 * (z + 3.0) / 6.0;
    // Cells of a tenth of a pixel, and what light surfaces throw back: none.
    EXPECT_LT(irradiance(floor, view.field, x, z), 0.05) << z;
    EXPECT_GT(irradiance(floor, view.field, x + 3.0 * rod, z), 0.95) << z;
  }
}

TEST(ViewField, OnlyWhatIsSeenIsDivided) {
  Scene scene = floor_half_in_the_sun();
  const SolvedFloor floor(std::move(scene), 0.5);
  const ViewField view = view_field(floor.field(), floor.square({1.0, 0, 1.0}, 0.2, 64), 1.0, {});
  const IrradianceField& before = floor.field();
  ASSERT_GT(view.field.corners().size(), before.corners().size());
  // The values of the mesh come first, as they were, and elsewhere are what is looked up.
  for (std::size_t v = 0; v < before.irradiance.size(); ++v)
    EXPECT_EQ(view.field.irradiance[v], before.irradiance[v]);
  Random random(4);
  for (int n = 0; n < 200; ++n) {
    const double x = random.between(-1.9, 0.4), z = random.between(-1.9, 1.9);
    EXPECT_EQ(irradiance(floor, view.field, x, z), irradiance(floor, before, x, z));
  }
}

TEST(ViewField, IsTheSameWithAnyNumberOfThreads) {
  Scene scene;
  add_floor(scene);
  add_polygon(scene, "lamp", lamp_over_the_floor(), diffuse(0.0, 10.0));
  scene.lights = {sun_from_above()};
  add_polygon(scene, "blade", {{-3, 1, -3}, {-3, 1, 3}, {0.1, 1, 3}, {0.3, 1, -3}},
              double_sided(diffuse(0.0)));
  const SolvedFloor floor(std::move(scene), 0.5);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return view_field(floor.field(), floor.square({0, 0, 0}, 1.0, 48), 1.0, {});
  };
  const ViewField one = with_threads(1), four = with_threads(4);
  EXPECT_EQ(one.field.irradiance, four.field.irradiance);
  EXPECT_EQ(one.field.lookup().descent, four.field.lookup().descent);
}

// A wall of no thickness stands on the floor, across its elements or along their edges, with the lamp on
// one side: on the other no light comes under it.
TEST(ViewField, NoLightPassesUnderAWall) {
  const std::vector<Point3> lamp{{1.0, 2, -0.5}, {1.5, 2, -0.5}, {1.5, 2, 0.5}, {1.0, 2, 0.5}};
  for (const double at : {0.13, 0.0, 0.5}) {
    Scene scene;
    add_floor(scene);
    add_polygon(scene, "wall", {{at, 0, -2}, {at, 3, -2}, {at, 3, 2}, {at, 0, 2}},
                double_sided(diffuse(0.0)));
    add_polygon(scene, "lamp", lamp, diffuse(0.0, 10.0));
    const SolvedFloor floor(std::move(scene), 0.5);
    const ViewField view = view_field(floor.field(), floor.square({at, 0, 0}, 0.6, 64), 1.0, {});
    Random random(6);
    for (int n = 0; n < 300; ++n) {
      const double z = random.between(-0.6, 0.6), away = random.between(1e-4, 0.5);
      const double exact = 10.0 * point_form_factor({at + away, 0, z}, {0, 1, 0}, lamp);
      EXPECT_EQ(irradiance(floor, view.field, at - away, z), 0.0) << at << " " << away << " " << z;
      EXPECT_NEAR(irradiance(floor, view.field, at + away, z), exact, 0.02 * exact)
          << at << " " << away << " " << z;
    }
  }
}

// Elements of different sizes: the smaller ones' corners in the middle of a larger edge are no cracks.
TEST(ViewField, HasNoCracksBesideSmallerElements) {
  const Scene scene = floor_half_under_a_lamp();
  const SolvedFloor coarse(scene, 1.0);
  std::vector<std::uint8_t> marked(element_count(coarse.scene->mesh), 0);
  for (const std::size_t e : elements_of(*coarse.scene, "floor"))
    marked[e] = e % 3 == 0 ? 1 : 0;
  SolvedFloor floor(scene, 1.0);
  floor.scene->mesh = divide_elements(coarse.scene->mesh, floor.scene->surfaces, marked);
  ASSERT_FALSE(floor.scene->mesh.hanging.empty());
  floor.scene->light = light_scene_on(floor.scene->light, floor.scene->mesh);
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  floor.solution = solve_pass_one(floor.scene->light, settings);
  const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, 1.9, 64), 1.0, {});
  expect_no_cracks(floor, view.field);
  // The same where no element is divided.
  const ViewField whole = view_field(floor.field(), floor.square({0, 0, 0}, 1.9, 64), 1.0,
                                     {.coarse = 1e3, .tolerance = 1e3});
  expect_no_cracks(floor, whole.field);
}

// A blade just over the floor, under a lamp of 2 cm: the edge of its shadow is sharp, and half a pixel
// away from it light is right.
TEST(ViewField, ASharpEdgeEndsWithinAPixel) {
  constexpr double half = 1.5, pixel = 2.0 * half / 200, slope = 0.37;
  const std::vector<Point3> lamp{
      {-0.01, 2, -0.01}, {0.01, 2, -0.01}, {0.01, 2, 0.01}, {-0.01, 2, 0.01}};
  Scene scene;
  add_floor(scene);
  add_polygon(scene, "lamp", lamp, diffuse(0.0, 1e4));
  add_polygon(scene, "blade",
              {{-3, 1e-3, -3}, {-3, 1e-3, 3}, {3.0 * slope, 1e-3, 3}, {-3.0 * slope, 1e-3, -3}},
              double_sided(diffuse(0.0)));
  const SolvedFloor floor(std::move(scene), 1.0);
  const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, half, 200), 1.0, {});
  Random random(7);
  int wrong = 0;
  constexpr int points = 4000;
  for (int n = 0; n < points; ++n) {
    const double z = random.between(-1.4, 1.4), away = random.between(0.5, 2.0) * pixel;
    for (const double side : {-1.0, 1.0}) {
      const double x = slope * z + side * away;
      const double lit = 1e4 * point_form_factor({x, 0, z}, {0, 1, 0}, lamp);
      wrong += std::abs(irradiance(floor, view.field, x, z) - (side > 0.0 ? lit : 0.0)) > 0.1 * lit;
    }
  }
  EXPECT_LT(wrong, points / 100);
}

/// Where the light along a line of constant z ends: its integral over x by that of lit places, metres from `from`.
double place_of_edge(const SolvedFloor& floor, const IrradianceField& field, double from, double to, double z) {
  constexpr int steps = 20000;
  double sum = 0.0;
  for (int k = 0; k < steps; ++k)
    sum += irradiance(floor, field, from + (to - from) * (k + 0.5) / steps, z);
  return to - (to - from) * sum / steps / irradiance(floor, field, to, z);
}

// Edges parallel to the lattice cross all cells in the same way: without the mean over footprints they are off by up to a tenth
// of a pixel along their whole length. Eight points in a footprint of at most 0.2 pixels leave a fortieth of a pixel.
TEST(ViewField, EdgesAlongTheLatticeAreInTheirPlace) {
  constexpr double half = 1.0, pixel = 2.0 * half / 100;
  const std::vector<Point3> lamp{{-0.01, 2, -0.01}, {0.01, 2, -0.01}, {0.01, 2, 0.01}, {-0.01, 2, 0.01}};
  for (const bool is_sun : {true, false})
    for (int k = 0; k < 8; ++k) {
      const double edge = (0.3 + 0.37 * k) * pixel, height = is_sun ? 1.0 : 0.1, up = 2.0,
                   blade = is_sun ? edge : edge * (up - height) / up;
      Scene scene;
      add_floor(scene);
      if (is_sun)
        scene.lights = {sun_from_above()};
      else
        add_polygon(scene, "lamp", lamp, diffuse(0.0, 1e4));
      add_polygon(scene, "blade", {{-3, height, -3}, {-3, height, 3}, {blade, height, 3}, {blade, height, -3}},
                  double_sided(diffuse(0.0)));
      const SolvedFloor floor(std::move(scene), 1.0);
      const ViewField view = view_field(floor.field(), floor.square({0, 0, 0}, half, 100), 1.0, {.finest = 0.2});
      for (const double z : {-0.501, 0.237, 0.4})
        EXPECT_NEAR(place_of_edge(floor, view.field, edge - 2.0 * pixel, edge + 2.0 * pixel, z), edge, pixel / 40.0)
            << (is_sun ? "sun" : "lamp") << " at " << edge / pixel << " pixels, z " << z;
    }
}

} // namespace
} // namespace meninas::test
