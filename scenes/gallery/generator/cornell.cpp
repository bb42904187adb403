// The Cornell box (Goral et al. 1984; measured by Cornell's Program of Computer Graphics),
// ten times as large, so that it is a room of 5.5 m;
// its walls are made straight and parallel. Fronts only, open towards the camera.
#include "scenes/gallery/generator/shapes.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static constexpr Point3 low{0.0, 0.0, 0.0};
static constexpr Point3 high{5.528, 5.488, 5.592};

static const Paint white = diffuse("white", {0.73, 0.73, 0.73});
static const Paint red = diffuse("red", {0.63, 0.065, 0.05});
static const Paint green = diffuse("green", {0.14, 0.45, 0.09});
static const Paint lamp = light("lamp", {17.0, 12.0, 4.0});

/// Floor, ceiling with the lamp let into it, back and right wall, blocks: what both boxes have.
static Stage common_box(std::string name) {
  Stage stage{std::move(name), {}, {{"main", {2.78, 2.73, -8.0}, {2.78, 2.73, 0.0}, 39.3, 1.0}}};
  stage.add("floor", white, room_wall(low, high, Face::y0));
  stage.add("back", white, room_wall(low, high, Face::z1));
  stage.add("right", green, room_wall(low, high, Face::x0));

  const Sheet ceiling{{0.0, high.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect opening{{2.13, 2.27}, {3.43, 3.32}};
  stage.add("ceiling", white, wall(ceiling, {{0.0, 0.0}, {high.x, high.z}}, std::array{opening}));
  stage.add("lamp", lamp, panel(ceiling, opening, 0.0));

  const std::array short_base{Vec2(1.30, 0.65), Vec2(0.82, 2.25), Vec2(2.40, 2.72),
                              Vec2(2.90, 1.14)};
  const std::array tall_base{Vec2(4.23, 2.47), Vec2(2.65, 2.96), Vec2(3.14, 4.56),
                             Vec2(4.72, 4.06)};
  stage.add("short-block", white, standing_prism(short_base, 0.0, 1.65));
  stage.add("tall-block", white, standing_prism(tall_base, 0.0, 3.30));
  return stage;
}

Stage cornell() {
  auto stage = common_box("cornell");
  stage.add("left", red, room_wall(low, high, Face::x1));
  return stage;
}

Stage cornell_mirror() {
  auto stage = common_box("cornell-mirror");

  // The mirror is let into the left wall:
  // high enough to throw the lamp's light across the floor in front.
  const Sheet left{{high.x, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  const Rect opening{{0.8, 0.9}, {4.6, 4.1}};
  stage.add("left", red, wall(left, {{0.0, 0.0}, {high.z, high.y}}, std::array{opening}));
  stage.add("mirror", mirror("mirror", Rgb(0.95)), panel(left, opening, 0.0));
  stage.views.push_back({"mirror", {0.4, 2.9, 0.6}, {5.5, 2.4, 3.2}, 60.0, 1.0});
  return stage;
}

} // namespace meninas::gallery
