// The floor lamp, the lantern, the curtains and the standing mirror.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/living_room/pieces.h"

#include <cmath>
#include <numbers>

namespace meninas::gallery {

static constexpr double circle = 2.0 * std::numbers::pi;

/// Both sides of it receive light and pass some of it on.
static Paint thin_cloth(const std::string& name, const Rgb& reflectance, double transmission) {
  Paint paint = diffuse(name, reflectance);
  paint.transmission = transmission;
  return paint;
}

void add_floor_lamp(Stage& stage, const Place& place) {
  const std::vector<Vec2> post{{0.0, 0.0},    {0.13, 0.0},   {0.13, 0.0},   {0.135, 0.008},
                               {0.12, 0.018}, {0.03, 0.028}, {0.012, 0.05}, {0.011, 0.6},
                               {0.018, 0.62}, {0.011, 0.64}, {0.011, 1.42}, {0.011, 1.42},
                               {0.0, 1.42}};
  stage.add("floor-lamp", diffuse("brass", {0.5, 0.38, 0.18}),
            placed(turned_body(Point3(0.0), rounded_profile(post, 8), 48), place));
  // A cone without lids, its front outwards.
  const auto shade = [](double s, double t) {
    const double radius = std::lerp(0.22, 0.14, t);
    return Point3(radius * std::sin(circle * s), 1.36 + 0.3 * t, radius * std::cos(circle * s));
  };
  stage.add("lamp-shade", thin_cloth("shade", {0.8, 0.7, 0.52}, 0.45),
            placed(sheet_of(shade, 72, 8), place));
  stage.add("bulb", light("bulb", {190.0, 140.0, 85.0}),
            placed(ball({0.0, 1.475, 0.0}, 0.04, 12), place));
}

void add_lantern(Stage& stage, const Point3& hook) {
  stage.add("lantern", light("lantern", {5.5, 4.6, 3.4}),
            ball(hook - Vec3(0.0, 0.6, 0.0), 0.15, 32));
  const std::vector<Point3> cord{hook - Vec3(0.0, 0.449, 0.0), hook - Vec3(0.0, 0.0005, 0.0)};
  stage.add("cord", diffuse("cord", Rgb(0.1)), tube(cord, 0.004, 0.004, 12));
}

void add_curtains(Stage& stage, double from, double to) {
  const Paint linen = thin_cloth("linen", {0.74, 0.7, 0.62}, 0.3);
  int half = 0;
  for (const double start : {from, to}) {
    const double width = start == from ? 0.5 : -0.5;
    // Folds that open towards the hem; both halves hang outside of the window.
    const auto at = [&](double s, double t) {
      const double depth = 0.028 + 0.02 * (1.0 - t);
      const double phase = circle * 7.0 * s + 0.5 * std::sin(2.2 * t + 9.0 * s + start);
      const double sway = 0.012 * std::sin(3.0 * t + 5.0 * s);
      return Point3(0.135 + depth * std::sin(phase) + sway, 0.025 + 2.46 * t,
                    start - width * s * (1.0 + 0.1 * (1.0 - t)));
    };
    stage.add("curtain-" + std::to_string(++half), linen, sheet_of(at, 176, 32));
  }
  const std::vector<Point3> rod{{0.135, 2.53, from - 0.62}, {0.135, 2.53, to + 0.62}};
  stage.add("curtain-rod", diffuse("brass", {0.5, 0.38, 0.18}), tube(rod, 0.014, 0.014, 24));
}

void add_standing_mirror(Stage& stage, const Place& place) {
  const Rect glass{{-0.3, 0.22}, {0.3, 1.7}};
  const Sheet sheet{Point3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Moulding moulding{0.05, 0.035, 0.02};
  const Rect outside = grown(glass, moulding.width);
  const auto lean = [&](Mesh mesh) {
    return placed(turned(std::move(mesh), Point3(0.0), {1.0, 0.0, 0.0}, -4.0), place);
  };
  const Sheet back{Point3(0.0), {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  stage.add("standing-mirror", mirror("silvered", {0.92, 0.92, 0.91}),
            lean(panel(sheet, glass, 0.02)));
  stage.add("standing-mirror-frame", dark_wood(),
            lean(box_mapped(
                merged(std::array{frame(sheet, glass, moulding), panel(back, outside, 0.0)}))));
  std::vector<Mesh> posts;
  const std::vector<Vec2> profile{{0.0, 0.0},   {0.022, 0.0},  {0.022, 0.0},  {0.028, 0.04},
                                  {0.018, 0.1}, {0.02, 0.5},   {0.026, 0.6},  {0.02, 0.7},
                                  {0.018, 1.2}, {0.024, 1.26}, {0.012, 1.29}, {0.02, 1.32},
                                  {0.0, 1.345}};
  for (const double x : {-0.385, 0.385})
    posts.push_back(turned_body({x, 0.0, -0.05}, rounded_profile(profile, 6), 32));
  posts.push_back(
      tube(std::array{Point3(-0.362, 0.07, -0.05), Point3(0.362, 0.07, -0.05)}, 0.014, 0.014, 20));
  stage.add("standing-mirror-posts", diffuse("turned-wood", {0.2, 0.12, 0.07}),
            placed(merged(posts), place));
}

} // namespace meninas::gallery
