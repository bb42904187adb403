// Test cases after CIE 171:2006, "Test cases to assess the accuracy of lighting computer programs": those with
// an analytical answer, each derived here anew, since tables of the report have errata (Ashdown 2016,
// "CIE 171:2006 - Errata"). A "4 x 4 x 3 m room" has its corner at the origin and is black but where said.
//
//   corner of a parallel rectangle      c = 1 / 2 pi (A / sqrt(1 + A^2) atan(B / sqrt(1 + A^2)) + the same with A, B exchanged)
//   corner of a perpendicular rectangle c = 1 / 2 pi (atan(1 / Y) - Y / sqrt(X^2 + Y^2) atan(1 / sqrt(X^2 + Y^2)))
//
// (configuration factors of differential elements, as in Howell's catalogue), A, B, X and Y the sides and the
// distance in parts of one another, below; other rectangles are sums and differences of such.
#include "radiosity/pass_one.h"
#include "radiosity/queries/point_light.h"
#include "scenes/ies/ies_file.h"
#include "scenes/photometry.h"
#include "scenes/sky/analytic_sky.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

namespace meninas::test {
namespace {

constexpr double pi = std::numbers::pi, efficacy = 683.0;

/// From a point `height` before a corner of the rectangle 0..a, 0..b, parallel to it; odd in a and b.
double parallel_corner(double a, double b, double height) {
  const double A = a / height, B = b / height;
  const double s = std::sqrt(1.0 + A * A), t = std::sqrt(1.0 + B * B);
  return (A / s * std::atan(B / s) + B / t * std::atan(A / t)) / (2.0 * pi);
}

struct Rectangle {
  double a0, a1, b0, b1;
};

/// Of a rectangle by its distances along both axes from the foot of the normal through the point.
double parallel_factor(const Rectangle& r, double height) {
  return parallel_corner(r.a1, r.b1, height) - parallel_corner(r.a0, r.b1, height) -
         parallel_corner(r.a1, r.b0, height) + parallel_corner(r.a0, r.b0, height);
}

/// From a point `height` up a wall to the floor 0..depth before it, 0..b along it from the point's foot; odd in b.
double perpendicular_corner(double depth, double b, double height) {
  if (b == 0.0)
    return 0.0;
  const double Y = height / std::abs(b), X = depth / std::abs(b), root = std::sqrt(X * X + Y * Y);
  const double c = (std::atan(1.0 / Y) - Y / root * std::atan(1.0 / root)) / (2.0 * pi);
  return std::copysign(c, b);
}

/// a along the normal of the wall, b along the wall.
double perpendicular_factor(const Rectangle& r, double height) {
  return perpendicular_corner(r.a1, r.b1, height) - perpendicular_corner(r.a0, r.b1, height) -
         perpendicular_corner(r.a1, r.b0, height) + perpendicular_corner(r.a0, r.b0, height);
}

std::vector<PointIrradiance> light_at(const Scene& scene, const std::vector<QueryPoint>& points,
                                      int rays = 4096) {
  MeshSettings mesh;
  mesh.element_size = 0.25;
  PassOneSettings settings;
  settings.form_factors.rays = settings.interpolation.rays = 64;
  const auto l = lit(scene, mesh);
  std::vector<Rgb> reflected = solve_pass_one(l->light, settings).radiosity;
  if (std::ranges::any_of(scene.materials, is_emitter)) // then all is black
    std::ranges::fill(reflected, Rgb(0.0));
  return irradiance_at_points(*l->light, reflected, points, {.rays = rays});
}

constexpr Direction up(0, 1, 0), down(0, -1, 0);

/// The six walls of the room, but for the ceiling.
Scene black_room() {
  Scene scene;
  add_room(scene, Point3(0.0), {4, 3, 4},
           {diffuse(0.0), diffuse(0.0), diffuse(0.0), diffuse(0.0), diffuse(0.0), diffuse(0.0)});
  return scene;
}

// --- 5.2: a point lamp with a measured distribution in the middle of the ceiling

TEST(Cie171, PointLampWithADistribution) {
  // I = 1000 cos^2 g cd, a value a degree: between them linear, off by h^2 / 8 I'' = 8e-5 of I(0).
  std::string angles, candela;
  for (int g = 0; g <= 90; ++g) {
    angles += std::to_string(g) + '\n';
    candela += std::to_string(1000.0 * std::pow(std::cos(g * pi / 180.0), 2.0)) + '\n';
  }
  Scene scene = black_room();
  scene.lights.push_back(
      {.name = "lamp",
       .intensity = Rgb(1.0 / efficacy),
       .position = {2.0, 3.0 - 1e-6, 2.0},
       .distribution = std::make_shared<const IntensityDistribution>(
           parse_ies("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 91 1 1 2 0 0 0\n1 1 1\n" + angles + "0\n" + candela)),
       .frame = glm::dmat3(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0))});
  std::vector<QueryPoint> points;
  for (const double x : {0.5, 1.5, 2.0, 3.5}) {
    points.push_back({{x, 0.0, 2.5}, up});
    points.push_back({{0.0, 0.5 * x, 1.5}, {1, 0, 0}});
  }
  const auto light = light_at(scene, points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 d = scene.lights[0].position - points[k].position;
    const double r = glm::length(d), cos_lamp = d.y / r, cos_point = glm::dot(d, points[k].normal) / r;
    const double exact = 1000.0 * cos_lamp * cos_lamp * cos_point / (r * r);
    EXPECT_NEAR(luminous(efficacy, light[k].total), exact, 1e-3 * exact) << k;
  }
}

// --- 5.3: a Lambertian ceiling panel of 1 x 1 m in the middle of the ceiling, also before a mirror

void add_panel(Scene& scene, double radiosity) {
  add_polygon(scene, "panel", {{1.5, 2.9, 1.5}, {2.5, 2.9, 1.5}, {2.5, 2.9, 2.5}, {1.5, 2.9, 2.5}},
              diffuse(0.0, radiosity));
}

TEST(Cie171, AreaLamp) {
  for (const double reflectance : {0.0, 0.75}) {
    Scene scene;
    const Material black = diffuse(0.0);
    add_room(scene, Point3(0.0), {4, 3, 4},
             {black, reflectance > 0.0 ? mirror(reflectance) : black, black, black, black, black});
    add_panel(scene, 1.0);
    std::vector<QueryPoint> points;
    std::vector<double> exact;
    for (const double x : {0.25, 1.0, 2.0, 2.75}) {
      points.push_back({{x, 0.0, 1.25}, up});
      // The mirror x = 4 makes an image from 5.5 to 6.5.
      exact.push_back(
          parallel_factor({1.5 - x, 2.5 - x, 0.25, 1.25}, 2.9) +
          reflectance * parallel_factor({5.5 - x, 6.5 - x, 0.25, 1.25}, 2.9));
      const double y = 0.7 * x; // on the wall x = 0, seen from below the panel's plane
      points.push_back({{0.0, y, 1.25}, {1, 0, 0}});
      exact.push_back(perpendicular_factor({1.5, 2.5, 0.25, 1.25}, 2.9 - y) +
                      reflectance * perpendicular_factor({5.5, 6.5, 0.25, 1.25}, 2.9 - y));
    }
    const auto light = light_at(scene, points);
    // Closed forms both; rays in floats tell only that nothing is in between.
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_NEAR(light[k].total.g, exact[k], 1e-6 * exact[k]) << k << ' ' << reflectance;
  }
}

// --- 5.6 and 5.7: what a floor reflects to a wall and a ceiling, E / (E_floor rho) = c

constexpr double floor_reflectance = 0.3;

/// The floor x0..x1, z0..z1 under a sun of 1 W/m^2 from straight above.
Scene lit_floor(double x0, double x1, double z0, double z1) {
  Scene scene;
  add_polygon(scene, "floor", {{x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}, {x0, 0, z0}}, diffuse(floor_reflectance));
  PunctualLight sun{.name = "sun", .kind = PunctualKind::directional, .intensity = Rgb(1.0)};
  sun.direction = {0, -1, 0};
  scene.lights.push_back(sun);
  return scene;
}

/// On the wall x = 0 and on the ceiling, along the middle of the room.
const std::vector<QueryPoint> wall_and_ceiling{
    {{0.0, 0.5, 2.0}, {1, 0, 0}}, {{0.0, 1.5, 2.0}, {1, 0, 0}}, {{0.0, 2.5, 2.0}, {1, 0, 0}},
    {{0.5, 3.0, 2.0}, down},      {{2.0, 3.0, 2.0}, down},      {{3.5, 3.0, 2.0}, down}};

/// What a point sees of the strip x0..x1, z0..z1 of the floor.
double strip_factor(const QueryPoint& at, double x0, double x1, double z0, double z1) {
  const Point3& p = at.position;
  return at.normal.y < 0.0 ? parallel_factor({x0 - p.x, x1 - p.x, z0 - p.z, z1 - p.z}, p.y)
                           : perpendicular_factor({x0 - p.x, x1 - p.x, z0 - p.z, z1 - p.z}, p.y);
}

/// Rays whose points have low discrepancy are off by about N^-3/4 of the hemisphere where what they meet has edges.
void expect_reflected(const Scene& scene, int rays,
                      const std::function<double(const QueryPoint&)>& factor) {
  const auto light = light_at(scene, wall_and_ceiling, rays);
  for (std::size_t k = 0; k < wall_and_ceiling.size(); ++k) {
    const double exact = factor(wall_and_ceiling[k]);
    // The sun itself shines on what faces up alone.
    EXPECT_NEAR(light[k].total.g / floor_reflectance, exact, std::pow(rays, -0.75)) << k;
  }
}

TEST(Cie171, ReflectionOfAFloor) {
  expect_reflected(lit_floor(0, 4, 0, 4), 1 << 14,
                   [](const QueryPoint& at) { return strip_factor(at, 0, 4, 0, 4); });
}

TEST(Cie171, ReflectionOfASmallFloor) {
  // The least factor is 0.004: 2 % of it.
  expect_reflected(lit_floor(1.75, 2.25, 1.75, 2.25), 1 << 18,
                   [](const QueryPoint& at) { return strip_factor(at, 1.75, 2.25, 1.75, 2.25); });
}

/// Behind a board of that height across the floor at x = 2, a point sees the floor from here on.
double end_of_shadow(const Point3& p, double board) {
  return p.y <= board ? 1e9 : p.x + (2.0 - p.x) * p.y / (p.y - board);
}

TEST(Cie171, ReflectionPastABoard) {
  constexpr double board = 1.0;
  Scene scene = lit_floor(0, 4, 0, 4);
  add_polygon(scene, "board", {{2, 0, 0}, {2, 0, 4}, {2, board, 4}, {2, board, 0}}, double_sided(diffuse(0.0)));
  expect_reflected(scene, 1 << 14, [](const QueryPoint& at) {
    const double end = end_of_shadow(at.position, board);
    // From beyond the board, the shadow lies on the near side of the room.
    if (at.position.x > 2.0)
      return strip_factor(at, 2, 4, 0, 4) + strip_factor(at, 0, std::max(0.0, end), 0, 4);
    return strip_factor(at, 0, 2, 0, 4) + (end < 4.0 ? strip_factor(at, end, 4, 0, 4) : 0.0);
  });
}

// --- 5.8: a cube of 4 m with a lamp of 10,000 lm in its middle, all walls alike

TEST(Cie171, IntegratingSphereFormula) {
  // Whatever the shape, A (1 - rho) <H> = flux, of which flux / A is direct: indirect <H> = flux rho / (A (1 - rho)).
  for (const double rho : {0.2, 0.5, 0.8, 0.95}) {
    Scene scene;
    const Material wall = diffuse(rho);
    add_room(scene, Point3(0.0), Point3(4.0), {wall, wall, wall, wall, wall, wall});
    scene.lights.push_back(
        {.name = "lamp", .intensity = Rgb(1e4 / (4.0 * pi) / efficacy), .position = Point3(2.0)});
    PassOneSettings settings;
    settings.form_factors.rays = settings.interpolation.rays = 256;
    MeshSettings mesh;
    mesh.element_size = 0.25;
    const auto l = lit(scene, mesh);
    const RadiositySolution solution = solve_pass_one(l->light, settings);
    Rgb mean(0.0);
    for (const char* node : {"x0", "x1", "y0", "y1", "z0", "z1"})
      mean += mean_over(*l, solution.irradiance, node) / 6.0;
    const double indirect = luminous(efficacy, mean) - 1e4 / 96.0;
    const double exact = 1e4 * rho / (96.0 * (1.0 - rho));
    // The solver stops at 1e-4 of the light, of which the indirect is a fifth at least.
    EXPECT_NEAR(indirect, exact, 1e-3 * exact) << rho;
  }
}

// --- 5.9 and 5.11: the sky through an opening without glass, in shares of the horizontal illuminance outside

using Luminance = std::function<double(const Direction&)>;

double overcast(const Direction& d) { return (1.0 + 2.0 * d.y) / 3.0; }

const Direction sun = glm::normalize(Vec3(std::cos(pi / 3.0), std::sin(pi / 3.0), 0.0)); // 60 degrees up

double clear(const Direction& d) {
  const auto scattering = [](double s) { return 0.91 + 10.0 * std::exp(-3.0 * s) + 0.45 * std::cos(s) * std::cos(s); };
  const double s = std::acos(std::min(1.0, glm::dot(d, sun)));
  return scattering(s) * (1.0 - std::exp(-0.32 / std::max(d.y, 1e-6)));
}

/// Integral of L cos over the hemisphere, by the middles of 2000 x 2000 parts of equal cosine-weighted angle.
double outside(const Luminance& luminance) {
  constexpr int n = 2000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double up2 = (i + 0.5) / n, azimuth = 2.0 * pi * (j + 0.5) / n, side = std::sqrt(1.0 - up2);
      sum += luminance({side * std::cos(azimuth), std::sqrt(up2), side * std::sin(azimuth)});
    }
  return pi * sum / (double(n) * n);
}

/// Integral of L cos cos' / d^2 over the parallelogram corner + s u + t v, by the middles of 1000 x 1000 parts:
/// the error falls with their size squared, 1e-6.
struct Opening {
  Point3 corner;
  Vec3 u, v;
};
double through(const Opening& opening, const QueryPoint& at, const Luminance& luminance) {
  constexpr int n = 1000;
  const Vec3 area = glm::cross(opening.u, opening.v) / (double(n) * n);
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 d = opening.corner + (i + 0.5) / n * opening.u + (j + 0.5) / n * opening.v - at.position;
      const double r2 = glm::dot(d, d), cosine = glm::dot(d, at.normal) / std::sqrt(r2);
      if (cosine > 0.0)
        sum += luminance(d / std::sqrt(r2)) * cosine * std::abs(glm::dot(d, area)) / (r2 * std::sqrt(r2));
    }
  return sum;
}

void add_wall_with_hole(Scene& scene, const Opening& whole, const Rectangle& hole, const Material& material) {
  const auto at = [&](double s, double t) { return whole.corner + s * whole.u + t * whole.v; };
  const std::array outer{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  const std::array inner{at(hole.a0, hole.b0), at(hole.a1, hole.b0), at(hole.a1, hole.b1), at(hole.a0, hole.b1)};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    add_polygon(scene, "part" + std::to_string(k), {outer[k], outer[next], inner[next], inner[k]}, material);
  }
}

/// In both skies, of 1 W/m^2 outside; the ground reflects a fifth. 2048 rays find how the sky differs across the
/// opening, within 0.1 %, or 4096 over the hemisphere, within 0.5 % by a whole roof.
void expect_daylight(Scene scene, const Opening& opening,
                     const std::vector<QueryPoint>& points, double tolerance = 1e-3) {
  for (const SkyKind kind : {SkyKind::overcast, SkyKind::clear}) {
    const Luminance above = kind == SkyKind::overcast ? overcast : clear;
    const double all = outside(above);
    const AnalyticSky made = make_analytic_sky({.kind = kind, .sun = sun, .illuminance = efficacy}, {});
    // The sun that is not in the picture of the sky shines on the ground nevertheless.
    const double ground = 0.2 / pi * (1.0 + (made.sun ? sun.y * made.sun->irradiance.g : 0.0));
    const Luminance everywhere = [&](const Direction& d) { return d.y > 0.0 ? above(d) / all : ground; };
    scene.background.map = std::make_shared<const RadianceMap>(made.map);
    const auto light = light_at(scene, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double exact = through(opening, points[k], everywhere);
      EXPECT_NEAR(light[k].total.g, exact, tolerance * exact) << k << ' ' << name_of(kind);
    }
  }
}

/// The five other walls.
Scene without(const char* name) {
  const Scene room = black_room();
  Scene scene = room;
  scene.triangles.clear();
  for (const Triangle& triangle : room.triangles)
    if (room.nodes[index(triangle.node)].name != name)
      scene.triangles.push_back(triangle);
  return scene;
}

TEST(Cie171, SkyThroughARoof) {
  Scene scene = without("y1");
  add_wall_with_hole(scene, {{0, 3, 0}, {4, 0, 0}, {0, 0, 4}}, {0.375, 0.625, 0.375, 0.625}, diffuse(0.0));
  expect_daylight(scene, {{1.5, 3, 1.5}, {1, 0, 0}, {0, 0, 1}},
                  {{{0.25, 0, 2}, up}, {{1.25, 0, 2}, up}, {{2, 0, 2}, up}, {{3.5, 0, 0.5}, up},
                   {{0, 0.5, 2}, {1, 0, 0}}, {{0, 1.5, 2}, {1, 0, 0}}, {{0, 2.5, 2}, {1, 0, 0}}});
}

TEST(Cie171, SkyThroughAWholeRoof) {
  expect_daylight(without("y1"), {{0, 3, 0}, {4, 0, 0}, {0, 0, 4}},
                  {{{0.25, 0, 2}, up}, {{2, 0, 2}, up}, {{0, 1.5, 2}, {1, 0, 0}}}, 5e-3);
}

TEST(Cie171, SkyAndGroundThroughAFacade) {
  Scene scene = without("x1");
  // 2 m wide and 1 m high, its sill at 1 m.
  add_wall_with_hole(scene, {{4, 0, 0}, {0, 0, 4}, {0, 3, 0}}, {0.25, 0.75, 1.0 / 3.0, 2.0 / 3.0}, diffuse(0.0));
  expect_daylight(scene, {{4, 1, 1}, {0, 0, 2}, {0, 1, 0}},
                  {{{3.5, 0, 2}, up}, {{2, 0, 2}, up}, {{0.5, 0, 2}, up}, {{2, 3, 2}, down},
                   {{0, 0.5, 2}, {1, 0, 0}}, {{0, 1.5, 2}, {1, 0, 0}}, {{0, 2.5, 2}, {1, 0, 0}}});
}

} // namespace
} // namespace meninas::test
