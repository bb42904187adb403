// Hemicubes: their delta form factors, what they see from a point,
// and how one at the centre stands for an element.
#include "mirror/convex_polygon.h"
#include "form_factors/area_form_factor.h"
#include "radiosity/transport/element_hemicube.h"
#include "form_factors/point_form_factor.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/random.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi;

struct CubeCell {
  Vec3 centre;  ///< on the cube
  double delta; ///< form factor
};

std::vector<CubeCell> cells_of(const Hemicube& cube) {
  std::vector<CubeCell> cells;
  for (std::size_t k = 0; k < cube.cells; ++k) {
    const HemicubePacket& packet = cube.packets[k / packet_size];
    const std::size_t lane = k % packet_size;
    cells.push_back({{packet.direction.x[lane], packet.direction.y[lane], packet.direction.z[lane]},
                     double{packet.weight[lane]} / static_cast<double>(cube.cells)});
  }
  return cells;
}

// Corners telescope, so only the rounding of a weight to a float is left: half of 2^-23 relative.
TEST(Hemicube, DeltaFormFactorsSumToOne) {
  for (const int resolution : {2, 6, 16, 50, 128, 512, 1024}) {
    const Hemicube cube = make_hemicube(resolution);
    EXPECT_EQ(cube.cells, 3U * static_cast<unsigned>(resolution * resolution));
    double sum = 0.0;
    for (const CubeCell& cell : cells_of(cube))
      sum += cell.delta;
    EXPECT_NEAR(sum, 1.0, 0x1p-24) << resolution;
  }
}

// The top is a square of half side 1 at distance 1:
// 4/(2 pi) 2/sqrt(2) atan(1/sqrt(2)); the sides share the rest.
TEST(Hemicube, FacesHaveTheirClosedForms) {
  const double top = 4.0 / (std::sqrt(2.0) * pi) * std::atan(1.0 / std::sqrt(2.0));
  EXPECT_NEAR(4.0 * top_corner_integral(1.0, 1.0), top, 1e-15);
  EXPECT_NEAR(2.0 * (side_corner_integral(1.0, 1.0) - side_corner_integral(1.0, 0.0)),
              0.25 * (1.0 - top), 1e-15);
  std::array<double, 5> sums{};
  for (const CubeCell& cell : cells_of(make_hemicube(48)))
    sums[cell.centre.z == 1.0     ? 0
         : cell.centre.x == 1.0   ? 1
         : cell.centre.y == 1.0   ? 2
         : cell.centre.x < -0.999 ? 3
                                  : 4] += cell.delta;
  EXPECT_NEAR(sums[0], top, 1e-7);
  for (std::size_t side = 1; side < 5; ++side)
    EXPECT_NEAR(sums[side], 0.25 * (1.0 - top), 1e-7);
}

// Two routes to one number:
// antiderivatives, and Lambert's formula for the cell as a polygon. Relative:
// a float's rounding, and 1e-16 that corners of size 0.1 lose against cells of 1e-4 or more.
TEST(Hemicube, EveryCellIsLambertsFormula) {
  constexpr int resolution = 20;
  for (const CubeCell& cell : cells_of(make_hemicube(resolution))) {
    const Vec3& c = cell.centre;
    const Vec3 out = c.z == 1.0             ? Vec3(0, 0, 1)
                     : std::abs(c.x) == 1.0 ? Vec3(c.x, 0, 0)
                                            : Vec3(0, c.y, 0);
    const Vec3 u = (out.x != 0.0 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)) / double(resolution);
    const Vec3 v = glm::cross(out, u);
    const std::array<Point3, 4> rectangle{c - u - v, c + u - v, c + u + v, c - u + v};
    const double exact = point_form_factor(Point3(0.0), {0, 0, 1}, rectangle);
    EXPECT_NEAR(cell.delta, exact, 1e-6 * exact);
  }
}

TEST(Hemicube, IsSymmetric) {
  auto cells = cells_of(make_hemicube(32));
  const auto sorted = [](std::vector<CubeCell> list) {
    std::ranges::sort(list, [](const CubeCell& a, const CubeCell& b) {
      return std::tie(a.centre.x, a.centre.y, a.centre.z) <
             std::tie(b.centre.x, b.centre.y, b.centre.z);
    });
    return list;
  };
  const auto before = sorted(cells);
  for (auto& cell : cells)
    cell.centre = {-cell.centre.y, cell.centre.x, cell.centre.z}; // a quarter turn
  const auto turned = sorted(cells);
  for (auto& cell : cells)
    cell.centre.x = -cell.centre.x;
  const auto reflected = sorted(cells);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(before[k].centre, turned[k].centre);
    EXPECT_EQ(before[k].centre, reflected[k].centre);
    EXPECT_NEAR(before[k].delta, turned[k].delta, 1e-6 * before[k].delta);
    EXPECT_NEAR(before[k].delta, reflected[k].delta, 1e-6 * before[k].delta);
  }
}

/// What a hemicube at the origin, normal +z, first edge +x,
/// sees of a polygon that is alone in the world.
double seen_by_cube(const std::vector<Point3>& polygon, int resolution) {
  Scene scene;
  add_polygon(scene, "polygon", polygon, double_sided(diffuse(0.5)));
  const auto l = lit(std::move(scene), {.target_elements = 1.0});
  ReceiverArea point;
  point.corner = Point3(0.0);
  point.normal = {0, 0, 1};
  point.tangent = {1, 0, 0};
  GatherWorkspace work;
  gather_rays(*l->light, make_hemicube(resolution), point, {}, work);
  return work.result.landed / work.result.rays;
}

// Outlines in general position:
// cells along them, some R of them, err by up to half of their 1/R^2 each, independently: R^(-3/2).
TEST(Hemicube, ConvergesToThePointFormFactorWithOrderThreeHalves) {
  Random random(7);
  std::array<double, 3> squares{};
  constexpr std::array resolutions{16, 64, 256};
  constexpr int count = 48;
  for (int n = 0; n < count; ++n) {
    std::vector<Point3> triangle;
    const Vec3 away = glm::normalize(random.in_box({-1, -1, 0.2}, {1, 1, 1}));
    for (int k = 0; k < 3; ++k)
      triangle.push_back(2.0 * away + 0.35 * random.direction());
    const double exact = point_form_factor(Point3(0.0), {0, 0, 1}, triangle);
    for (std::size_t k = 0; k < resolutions.size(); ++k) {
      const double error = seen_by_cube(triangle, resolutions[k]) - exact;
      squares[k] += error * error / count;
    }
  }
  for (std::size_t k = 0; k + 1 < resolutions.size(); ++k) {
    const double order = std::log2(squares[k] / squares[k + 1]) / 4.0;
    // Of 48 cases the rms is known to a tenth, the order to 0.1.
    EXPECT_NEAR(order, 1.5, 0.3);
  }
}

// Outlines along the rows of cells: all cells of an edge err alike,
// by up to half of the 4 / (pi R^2) of a cell at the pole. No better.
TEST(Hemicube, OutlinesAlongTheCellsConvergeWithOrderOne) {
  Random random(8);
  for (const int resolution : {16, 64, 256}) {
    double worst = 0.0;
    for (int n = 0; n < 24; ++n) {
      const double a = random.between(0.1, 0.6), b = random.between(0.1, 0.6);
      const std::vector<Point3> rectangle{{-a, -b, 1}, {-a, b, 1}, {a, b, 1}, {a, -b, 1}};
      const double exact = point_form_factor(Point3(0.0), {0, 0, 1}, rectangle);
      const double outline_cells = 4.0 * (a + b) * resolution / 2.0 + 4.0;
      const double bound = 0.5 * outline_cells * 4.0 / (pi * resolution * resolution);
      const double share = std::abs(seen_by_cube(rectangle, resolution) - exact) / bound;
      EXPECT_LT(share, 1.0);
      worst = std::max(worst, share);
    }
    EXPECT_GT(worst, 0.25) << resolution;
  }
}

TEST(ElementHemicube, StandsInTheMiddleOfWhatIsExposed) {
  const auto l = lit(furnace(0.5, {}, Point3(8.0)), {});
  const LightScene& light = *l->light;
  ReceiverArea quad;
  quad.corner = Point3(0.0);
  quad.edge_u = {8.0, 0.0, 0.0};
  quad.edge_v = {0.0, 8.0, 0.0};
  EXPECT_EQ(hemicube_position(light, quad, 0), Point3(4.0, 4.0, 0.0));
  constexpr ContactMask half = 0xffffffffULL; // s < 1/2
  const auto in_half = hemicube_position(light, quad, half);
  ASSERT_TRUE(in_half);
  EXPECT_LE(glm::distance(*in_half, Point3(6.0, 4.0, 0.0)), std::sqrt(0.5) + 1e-12);
  EXPECT_FALSE(hemicube_position(light, quad, ~ContactMask{0}));
  ReceiverArea triangle = quad;
  triangle.triangle = true;
  EXPECT_LT(glm::distance(*hemicube_position(light, triangle, 0), Point3(8.0 / 3.0, 8.0 / 3.0, 0.0)),
            1e-12);
}

constexpr FormFactorMethod by_cubes = FormFactorMethod::hemicube;

/// Two unit squares at right angles that share an edge.
Scene corner() {
  Scene scene;
  add_polygon(scene, "a", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  add_polygon(scene, "b", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, diffuse(0.5));
  return scene;
}

/// F_ab by hemicubes on n x n elements less the exact value.
double corner_error(int n, int resolution) {
  const auto l = lit(corner(), {.element_size = 1.0 / n});
  const auto factors =
      assemble_transport(*l->light, {.method = by_cubes, .hemicube_resolution = resolution});
  const double exact = 0.200043776075; // Howell C-14, H = W = 1
  return form_factor(*l, factors.transport, "a", "b") - exact;
}

// The error of a near element is that of its centre: cells do not cure it, elements do.
TEST(ElementHemicube, SeesFromTheCentreAlone) {
  const std::array<Point3, 4> wall{Point3(0, 0, 0), {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double centre_error = point_form_factor({0.5, 0.5, 0.0}, {0, 0, 1}, wall) - 0.200043776075;
  EXPECT_LT(centre_error, -0.009); // a twentieth of the form factor
  for (const int resolution : {64, 256, 512})
    EXPECT_NEAR(corner_error(1, resolution), centre_error, 0.1 / resolution) << resolution;
  // The rule of midpoints: the square of the element's size,
  // but for the corners of the common edge, where light changes at once.
  const double two = std::abs(corner_error(2, 256)), four = std::abs(corner_error(4, 256)),
               eight = std::abs(corner_error(8, 256));
  EXPECT_LT(two, 0.45 * std::abs(centre_error));
  EXPECT_LT(four, 0.45 * two);
  EXPECT_LT(eight, 0.45 * four);
}

// Elements that touch look the same at every size, and so does their error: it never goes.
TEST(ElementHemicube, TouchingElementsAreWrongAtEverySize) {
  const std::array<Point3, 4> wall{Point3(0, 0, 0), {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double centre = point_form_factor({0.5, 0.5, 0.0}, {0, 0, 1}, wall);
  for (const int n : {1, 2, 4}) {
    const auto l = lit(corner(), {.element_size = 1.0 / n});
    const auto factors =
        assemble_transport(*l->light, {.method = by_cubes, .hemicube_resolution = 256});
    const Transport& t = factors.transport;
    // The largest weight is that of two elements across the edge.
    const float largest = *std::max_element(t.weights.begin(), t.weights.end());
    EXPECT_NEAR(largest, centre, 0.1 / 256) << n;
    EXPECT_LT(largest, 0.96 * 0.200043776075) << n;
  }
}

TEST(ElementHemicube, SameBitsForAnyThreadCount) {
  const auto l = lit(facing_mirrors(Rgb(0.95, 0.9, 0.8)), {.element_size = 0.2});
  PassOneSettings settings;
  settings.form_factors.method = by_cubes;
  settings.form_factors.hemicube_resolution = 16;
  std::vector<RadiositySolution> runs;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    runs.push_back(solve_pass_one(l->light, settings));
  }
  for (const auto& run : runs) {
    EXPECT_EQ(run.irradiance, runs[0].irradiance);
    EXPECT_EQ(run.field.irradiance, runs[0].field.irradiance);
    EXPECT_EQ(run.form_factor_rays, runs[0].form_factor_rays);
  }
}

} // namespace
} // namespace meninas::test
