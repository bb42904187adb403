// A potted plant: bowed stems, and leaves that keep clear of one another.
#include "scenes/gallery/living_room/pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas::gallery {
namespace {

constexpr double golden_angle = 2.399963229728653; ///< pi (3 - sqrt(5)), radians
constexpr int stem_steps = 24;

/// From the soil up and outwards, bowed by its weight.
std::vector<Point3> stem_line(int k, int stems) {
  const double angle = 2.0 * std::numbers::pi * (k + 0.3 * chance(k)) / stems;
  const double lean = k == 0 ? 0.05 : 0.22 + 0.22 * chance(k + 10);
  const double height = 0.62 + 0.45 * chance(k + 30);
  const Vec3 out{std::cos(angle), 0.0, std::sin(angle)};
  std::vector<Point3> line;
  for (int i = 0; i <= stem_steps; ++i) {
    const double t = static_cast<double>(i) / stem_steps;
    line.push_back((0.045 + lean * std::pow(t, 1.6)) * out + Vec3(0.0, 0.3265 + height * t, 0.0));
  }
  return line;
}

/// Pointed at both ends, folded along its middle and bowed: an ellipsoid bent.
struct Leaf {
  Point3 base;
  Direction along, up; ///< unit, at right angles
  double length, droop;
};
Point3 on_leaf(const Leaf& leaf, double s, double side, double off) {
  const Vec3 across = glm::cross(leaf.along, leaf.up);
  const double fold = 0.25 * std::abs(side);
  const double fall = leaf.droop * s * s;
  return leaf.base + leaf.length * s * (1.0 - 0.3 * leaf.droop * s) * leaf.along + side * across +
         (fold - leaf.length * fall + off) * leaf.up;
}
Mesh leaf_body(const Leaf& leaf) {
  // s along the unit ellipsoid's x; its width is least at both ends.
  return bent(superellipsoid({Point3(0.0), {0.5, 0.02, 0.5}, 2.0, 2.0}, 6), [&](const Point3& p) {
    const double s = p.x + 0.5;
    const double narrow = 0.42 * leaf.length * (1.0 - 0.35 * s);
    return on_leaf(leaf, s, narrow * p.z, 0.05 * p.y);
  });
}

/// Points on the leaf, for distances.
std::vector<Point3> probes(const Leaf& leaf) {
  std::vector<Point3> points;
  for (int i = 1; i <= 6; ++i)
    for (int j = -1; j <= 1; ++j) {
      const double s = i / 6.0;
      const double half = 0.21 * leaf.length * std::sqrt(4.0 * s * (1.0 - s)) * (1.0 - 0.35 * s);
      points.push_back(on_leaf(leaf, s, 0.9 * half * j, 0.0));
    }
  return points;
}

bool keeps_clear(const std::vector<Point3>& points, const std::vector<Point3>& others,
                 double distance) {
  return std::ranges::none_of(points, [&](const Point3& p) {
    return std::ranges::any_of(others,
                               [&](const Point3& q) { return glm::distance(p, q) < distance; });
  });
}

} // namespace

void add_plant(Stage& stage, const Place& place, int leaves) {
  constexpr int stems = 9;
  std::vector<Mesh> green;
  std::vector<std::vector<Point3>> lines;
  std::vector<Point3> taken, wood;
  for (int k = 0; k < stems; ++k) {
    lines.push_back(stem_line(k, stems));
    green.push_back(tube(lines.back(), 0.006, 0.002, 12));
    wood.insert(wood.end(), lines.back().begin(), lines.back().end());
  }
  std::vector<Mesh> blades;
  for (std::uint64_t k = 0; static_cast<int>(blades.size()) < leaves && k < 40000; ++k) {
    const auto& line = lines[k % stems];
    const double t = 0.15 + 0.84 * chance(k + 1000);
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(t * stem_steps), stem_steps - 1);
    const double angle = golden_angle * static_cast<double>(k) + 0.6 * chance(k + 90000);
    const double rise = 0.2 + 0.6 * t * chance(k + 5000);
    const Direction along = glm::normalize(Vec3(std::cos(angle), rise, std::sin(angle)));
    const Direction up = glm::normalize(Vec3(0.0, 1.0, 0.0) - along.y * along);
    const Point3 on_stem = glm::mix(line[i], line[i + 1], t * stem_steps - static_cast<double>(i));
    const Leaf leaf{on_stem + 0.011 * along, along, up, 0.085 + 0.07 * chance(k + 7000),
                    0.15 + 0.5 * chance(k + 9000)};
    const auto points = probes(leaf);
    const bool clear = keeps_clear(points, taken, 0.019) && keeps_clear(points, wood, 0.017);
    if (!clear)
      continue;
    taken.insert(taken.end(), points.begin(), points.end());
    Mesh blade = leaf_body(leaf);
    blade.texcoords.clear();
    blades.push_back(std::move(blade));
  }
  const std::vector<Vec2> pot{{0.0, 0.0},   {0.12, 0.0},    {0.12, 0.0},   {0.15, 0.08},
                              {0.175, 0.3}, {0.178, 0.345}, {0.175, 0.35}, {0.165, 0.345},
                              {0.16, 0.3},  {0.135, 0.08},  {0.1, 0.02},   {0.0, 0.02}};
  const std::vector<Vec2> soil{{0.0, 0.03},   {0.1, 0.03},   {0.13, 0.1}, {0.156, 0.318},
                               {0.15, 0.324}, {0.15, 0.324}, {0.0, 0.326}};
  stage.add("plant-pot", diffuse("terracotta", {0.5, 0.25, 0.15}),
            placed(turned_body(Point3(0.0), rounded_profile(pot, 6), 96), place));
  stage.add("plant-soil", diffuse("soil", {0.08, 0.055, 0.04}),
            placed(turned_body(Point3(0.0), rounded_profile(soil, 4), 64), place));
  stage.add("plant-stems", diffuse("stem", {0.2, 0.32, 0.12}), placed(merged(green), place));
  stage.add("plant-leaves", diffuse("leaf", {0.13, 0.3, 0.09}), placed(merged(blades), place));
}

} // namespace meninas::gallery
