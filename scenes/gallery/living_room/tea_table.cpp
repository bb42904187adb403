// A round table on turned legs, a tea set on it, and flowers.
#include "scenes/gallery/living_room/pieces.h"

#include <cmath>
#include <numbers>

namespace meninas::gallery {
namespace {

constexpr double top = 0.46; ///< of the table

/// A flat disc with a rounded rim, textured from above.
Mesh table_top() {
  const std::vector<Vec2> rim{{0.0, 0.431},   {0.46, 0.431}, {0.46, 0.431},
                              {0.492, 0.436}, {0.5, 0.446},  {0.492, 0.456},
                              {0.47, top},    {0.47, top},   {0.0, top}};
  Mesh mesh = turned_body(Point3(0.0), rounded_profile(rim, 4), 96);
  for (const Point3& p : mesh.positions)
    mesh.texcoords.emplace_back(p.x / 0.6, p.z / 0.6);
  return mesh;
}

Mesh leg(double angle) {
  const std::vector<Vec2> profile{{0.0, 0.0},    {0.02, 0.0},   {0.02, 0.0},   {0.026, 0.02},
                                  {0.016, 0.05}, {0.02, 0.14},  {0.034, 0.22}, {0.022, 0.3},
                                  {0.03, 0.315}, {0.022, 0.33}, {0.03, 0.36},  {0.032, 0.43},
                                  {0.032, 0.43}, {0.0, 0.43}};
  return turned_body({0.34 * std::cos(angle), 0.0, 0.34 * std::sin(angle)},
                     rounded_profile(profile, 6), 40);
}

/// Part of a circle in the plane that holds the axis and `out`, from one angle to another.
Mesh handle(const Point3& centre, const Direction& out, double radius, double thickness,
            double degrees) {
  std::vector<Point3> line;
  for (int k = 0; k <= 24; ++k) {
    const double angle = glm::radians(degrees) * (k / 12.0 - 1.0);
    line.push_back(centre +
                   radius * (std::cos(angle) * out + std::sin(angle) * Vec3(0.0, 1.0, 0.0)));
  }
  return tube(line, thickness, thickness, 16);
}

Mesh teapot() {
  const std::vector<Vec2> body{{0.0, 0.0},     {0.045, 0.0},   {0.045, 0.0},   {0.05, 0.008},
                               {0.078, 0.04},  {0.085, 0.07},  {0.072, 0.105}, {0.045, 0.128},
                               {0.045, 0.128}, {0.047, 0.133}, {0.03, 0.143},  {0.01, 0.148},
                               {0.008, 0.154}, {0.014, 0.165}, {0.008, 0.174}, {0.0, 0.176}};
  std::vector<Point3> spout;
  for (int k = 0; k <= 20; ++k) {
    const double t = k / 20.0;
    spout.emplace_back(-0.0865 - 0.07 * t, 0.066 + 0.075 * t * t, 0.0);
  }
  return merged(std::array{turned_body(Point3(0.0), rounded_profile(body, 8), 64),
                           tube(spout, 0.016, 0.009, 24),
                           handle({0.097, 0.075, 0.0}, {1.0, 0.0, 0.0}, 0.036, 0.006, 106.0)});
}

Mesh cup() {
  const std::vector<Vec2> saucer{{0.0, 0.0},     {0.03, 0.0},    {0.03, 0.0},
                                 {0.07, 0.013},  {0.07, 0.013},  {0.07, 0.0155},
                                 {0.07, 0.0155}, {0.032, 0.005}, {0.0, 0.005}};
  const std::vector<Vec2> bowl{{0.0, 0.0055},  {0.022, 0.0055}, {0.022, 0.0055}, {0.034, 0.025},
                               {0.042, 0.06},  {0.042, 0.06},   {0.0395, 0.06},  {0.0395, 0.06},
                               {0.031, 0.026}, {0.018, 0.011},  {0.0, 0.01}};
  return merged(std::array{turned_body(Point3(0.0), rounded_profile(saucer, 5), 48),
                           turned_body(Point3(0.0), rounded_profile(bowl, 6), 48),
                           handle({0.0505, 0.038, 0.0}, {1.0, 0.0, 0.0}, 0.013, 0.003, 112.0)});
}

Mesh vase() {
  const std::vector<Vec2> profile{{0.0, 0.0},    {0.045, 0.0},   {0.045, 0.0},  {0.075, 0.07},
                                  {0.062, 0.15}, {0.032, 0.21},  {0.042, 0.25}, {0.042, 0.25},
                                  {0.039, 0.25}, {0.039, 0.25},  {0.027, 0.21}, {0.054, 0.15},
                                  {0.063, 0.07}, {0.035, 0.016}, {0.0, 0.012}};
  return turned_body(Point3(0.0), rounded_profile(profile, 8), 64);
}

/// Stems that part above the vase's neck, each with a round blossom of petals.
void add_flowers(Stage& stage, const Point3& foot, const Place& place) {
  std::vector<Mesh> stems, blossoms;
  for (int k = 0; k < 9; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.2 * chance(k)) / 9.0;
    const Vec3 out{std::cos(angle), 0.0, std::sin(angle)};
    const double spread = (k % 3 == 0 ? 0.04 : 0.14) + 0.02 * chance(k + 50);
    const double height = 0.43 + 0.09 * chance(k + 20) + (k % 3 == 0 ? 0.08 : 0.0);
    std::vector<Point3> line;
    for (int i = 0; i <= 16; ++i) {
      const double y = std::lerp(0.02, height, i / 16.0);
      const double above = std::max(0.0, (y - 0.24) / (height - 0.24)); // the neck
      line.push_back(foot + (0.016 + spread * std::pow(above, 1.5)) * out + Vec3(0.0, y, 0.0));
    }
    stems.push_back(tube(line, 0.0025, 0.002, 10));
    const Point3 centre = line.back() + Vec3(0.0, 0.034, 0.0);
    // Twelve lobes round the axis; waves are deepest at the equator.
    blossoms.push_back(
        bent(superellipsoid({centre, Vec3(0.031), 2.0, 2.0}, 14), [&](const Point3& p) {
          const Vec3 r = p - centre;
          const double wave =
              std::cos(9.0 * std::atan2(r.z, r.x)) * (1.0 - std::pow(r.y / 0.031, 2.0));
          return centre + (1.0 + 0.12 * wave) * Vec3(1.0, 0.8, 1.0) * r;
        }));
  }
  stage.add("stems", diffuse("stem", {0.2, 0.32, 0.12}), placed(merged(stems), place));
  for (auto& blossom : blossoms)
    blossom.texcoords.clear();
  stage.add("blossoms", diffuse("blossom", {0.75, 0.32, 0.28}), placed(merged(blossoms), place));
}

} // namespace

void add_tea_table(Stage& stage, const Place& place) {
  const double quarter = 0.5 * std::numbers::pi;
  std::vector<Mesh> legs;
  for (int k = 0; k < 4; ++k)
    legs.push_back(leg((k + 0.5) * quarter));
  stage.add("table-top", wood(), placed(table_top(), place));
  stage.add("table-legs", diffuse("turned-wood", {0.2, 0.12, 0.07}), placed(merged(legs), place));

  constexpr double on_top = top + 0.0005;
  stage.add(
      "teapot", porcelain(),
      placed(moved(turned(teapot(), Point3(0.0), {0.0, 1.0, 0.0}, 30.0), {0.12, on_top, 0.16}),
             place));
  std::vector<Mesh> cups;
  for (const auto& [x, z, degrees] : {std::tuple(-0.2, 0.22, -40.0), std::tuple(-0.3, -0.08, 130.0),
                                      std::tuple(0.3, -0.12, 20.0)})
    cups.push_back(moved(turned(cup(), Point3(0.0), {0.0, 1.0, 0.0}, degrees), {x, on_top, z}));
  stage.add("cups", porcelain(), placed(merged(cups), place));
  const Point3 vase_at{-0.02, on_top, -0.14};
  stage.add("vase", coated("glaze", {0.12, 0.28, 0.36}, 0.08),
            placed(moved(vase(), vase_at), place));
  add_flowers(stage, vase_at, place);
}

} // namespace meninas::gallery
