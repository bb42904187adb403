#include "scenes/gallery/generator/furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace meninas::gallery {

void add_room(Stage& stage, const Point3& low, const Point3& high, const Paint& paint,
              const Paint& floor, std::span<const Face> open) {
  static const std::array<std::pair<Face, const char*>, 6> walls{{{Face::y0, "floor"},
                                                                  {Face::y1, "ceiling"},
                                                                  {Face::x0, "left"},
                                                                  {Face::x1, "right"},
                                                                  {Face::z0, "back"},
                                                                  {Face::z1, "front"}}};
  for (const auto& [face, name] : walls)
    if (std::ranges::find(open, face) == open.end())
      stage.add(name, face == Face::y0 ? floor : paint, room_wall(low, high, face));
}

Mesh table(const Point3& low, const Point3& high, double thickness, double leg) {
  const auto under = high.y - thickness;
  std::vector<Mesh> meshes{box({low.x, under, low.z}, high)};
  for (const auto x : {low.x + 0.02, high.x - 0.02 - leg})
    for (const auto z : {low.z + 0.02, high.z - 0.02 - leg})
      meshes.push_back(
          box({x, low.y, z}, {x + leg, under, z + leg}, std::array{Face::y0, Face::y1}));
  return merged(meshes);
}

Mesh ball(const Point3& centre, double radius, int sides) {
  const auto rings = sides / 2;
  std::vector<Vec2> profile;
  for (int k = 0; k <= rings; ++k) {
    const auto angle = std::numbers::pi * k / rings;
    const auto is_pole = k == 0 || k == rings;
    profile.emplace_back(is_pole ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
  }
  return lathe(centre, profile, sides);
}

void add_tilted_mirror(Stage& stage, const std::string& name, const TiltedMirror& tilted,
                       const Paint& glass, const Paint& back) {
  const auto& c = tilted.centre;
  const Vec3 half{0.0, tilted.half_length, tilted.half_width};
  const Vec3 thickness{0.03, 0.0, 0.0};
  const auto tilt = [&](Mesh mesh) {
    return turned(std::move(mesh), c, {0.0, 0.0, 1.0}, tilted.degrees);
  };

  const Sheet front{c - half, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  const Rect whole{{0.0, 0.0}, {2.0 * tilted.half_width, 2.0 * tilted.half_length}};
  stage.add(name, glass, tilt(panel(front, whole, 0.0)));
  stage.add(name + ".back", back, tilt(box(c - half, c + half + thickness, std::array{Face::x0})));
}

} // namespace meninas::gallery
