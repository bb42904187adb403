// The same light twice, by the method of images: a room whose plane x = 0 is a perfect mirror,
// and the room made of it and its image, without the mirror.
// Where x > 0, both have the same radiosity and look the same.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static constexpr Point3 low{0.0, 0.0, 0.0};
static constexpr Point3 high{3.0, 2.6, 4.0};

static Stage real_half(std::string name) {
  Stage stage{
      std::move(name), {}, {{"main", {2.75, 1.6, 3.75}, {0.0, 0.95, 1.3}, 60.0, 4.0 / 3.0}}};
  const auto plaster = diffuse("plaster", {0.7, 0.68, 0.62});
  const auto wood = diffuse("wood", {0.45, 0.3, 0.18});
  const auto red = diffuse("red", {0.6, 0.1, 0.08});
  const auto blue = diffuse("blue", {0.12, 0.2, 0.5});
  add_room(stage, low, high, plaster, diffuse("boards", {0.5, 0.42, 0.33}),
           std::array{Face::x0, Face::y1});

  const Sheet ceiling{{0.0, high.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect opening{{1.3, 1.4}, {1.9, 2.0}};
  stage.add("ceiling", plaster, wall(ceiling, {{0.0, 0.0}, {high.x, high.z}}, std::array{opening}));
  stage.add("lamp", light("lamp", {14.0, 12.5, 10.0}), panel(ceiling, opening, 0.0));

  // Blockers of many kinds of legs: one that hangs, some that stand, one close to the mirror plane.
  stage.add("baffle", wood, box({0.95, 1.9, 1.2}, {1.0, 2.4, 2.2}));
  stage.add("table", wood, table({1.2, 0.0, 0.7}, {2.2, 0.75, 1.5}, 0.05, 0.06));
  stage.add("vase", blue,
            lathe({1.7, 0.75, 1.1},
                  std::array{Vec2(0.06, 0.0), Vec2(0.12, 0.14), Vec2(0.05, 0.3), Vec2(0.08, 0.36)},
                  12));
  stage.add("block", red, standing_box({0.25, 0.0, 2.3}, {0.75, 0.8, 2.8}));
  const std::array base{Vec2(0.2, 0.6), Vec2(0.6, 0.35), Vec2(0.75, 0.85)};
  stage.add("wedge", plaster, standing_prism(base, 0.0, 1.5));
  stage.add("reading-lamp", light("reading-lamp", {10.0, 7.0, 4.0}),
            quad({2.98, 1.2, 2.6}, {2.98, 1.2, 3.0}, {2.98, 1.5, 3.0}, {2.98, 1.5, 2.6}));
  return stage;
}

Stage half_room() {
  auto stage = real_half("half-room");
  stage.add("mirror", mirror("mirror", Rgb(1.0)), room_wall(low, high, Face::x0));
  return stage;
}

Stage doubled_room() {
  auto stage = real_half("doubled-room");
  const auto half = stage.parts;
  for (const auto& part : half)
    stage.add(part.name + ".image", part.paint, mirrored_in_x(part.mesh));
  return stage;
}

} // namespace meninas::gallery
