// Scenes about one path of light each:
// a mirror that throws it, two in a chain, and two that face each other.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static const Paint plaster = diffuse("plaster", {0.75, 0.73, 0.7});
static const Paint boards = diffuse("boards", {0.55, 0.45, 0.35});
static const Paint iron = diffuse("iron", {0.15, 0.15, 0.16});
static const Paint red = diffuse("red", {0.6, 0.12, 0.08});
static const Paint blue = diffuse("blue", {0.1, 0.2, 0.55});
static const Paint ochre = diffuse("ochre", {0.65, 0.45, 0.15});

/// A square tube along x, open at its far end, and a small lamp at the near end:
/// a beam that nothing else gets.
/// It is black inside, so that its own glow does not blur the beam.
static void add_shaded_lamp(Stage& stage) {
  const Point3 low{0.4, 2.18, 1.48};
  const Point3 high{1.5, 2.42, 1.72};
  const Vec3 shell{0.02};
  const Point3 inner_low = low + shell;
  const Point3 inner_high{high.x, high.y - shell.y, high.z - shell.z};

  std::vector<Mesh> inside;
  for (const auto face : {Face::x0, Face::y0, Face::y1, Face::z0, Face::z1})
    inside.push_back(room_wall(inner_low, inner_high, face));
  stage.add("shade.inside", diffuse("black", Rgb(0.0)), merged(inside));

  // Outer faces, and the rim that joins them to the inner ones at the open end.
  const Sheet rim{{high.x, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect opening{{inner_low.y, inner_low.z}, {inner_high.y, inner_high.z}};
  stage.add("shade", iron,
            merged(std::array{box(low, high, std::array{Face::x1}),
                              wall(rim, {{low.y, low.z}, {high.y, high.z}}, std::array{opening})}));

  const Sheet lamp{{inner_low.x + 0.01, 2.3, 1.6}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  stage.add("lamp", light("lamp", {24000.0, 20000.0, 15000.0}),
            panel(lamp, {Vec2(-0.03), Vec2(0.03)}, 0.0));
  stage.add("lamp-rod", iron,
            box({0.93, 2.42, 1.58}, {0.97, 3.0, 1.62}, std::array{Face::y0, Face::y1}));
}

Stage mirror_spot() {
  Stage stage{"mirror-spot",
              {},
              {{"main", {3.85, 1.75, 3.9}, {1.95, 1.05, 1.45}, 58.0, 4.0 / 3.0},
               {"spot", {2.2, 2.0, 2.9}, {2.25, 0.0, 1.55}, 50.0, 1.0}}};
  add_room(stage, {0.0, 0.0, 0.0}, {4.0, 3.0, 4.0}, plaster, boards);
  add_shaded_lamp(stage);
  add_tilted_mirror(stage, "mirror", {{2.2, 2.3, 1.6}, 0.45, 0.3, 45.0},
                    mirror("mirror", Rgb(0.95)), iron);
  stage.add("mirror-rod", iron, box({1.86, 2.67, 1.58}, {1.9, 3.0, 1.62}, std::array{Face::y1}));
  stage.add("box", red, standing_box({2.4, 0.0, 1.2}, {2.7, 0.35, 1.5}));
  stage.add("ball", ochre, ball({1.55, 0.25, 2.35}, 0.245, 16));
  return stage;
}

Stage periscope() {
  Stage stage{"periscope",
              {},
              {{"main", {2.9, 1.7, 8.6}, {2.9, 1.7, 0.0}, 40.0, 1.6},
               {"eyepiece", {0.5, 1.0, 1.5}, {2.0, 1.0, 1.5}, 40.0, 1.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{6.0, 3.4, 3.0};
  add_room(stage, low, high, plaster, boards, std::array{Face::x1});
  const Sheet right{{high.x, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  const Rect opening{{1.0, 2.5}, {2.0, 3.1}};
  stage.add("right", plaster, wall(right, {{0.0, 0.0}, {high.z, high.y}}, std::array{opening}));
  stage.add("window", light("window", {24.0, 23.0, 21.0}), panel(right, opening, 0.0));

  stage.add("partition", plaster,
            box({2.95, 0.0, 0.0}, {3.05, 2.4, 3.0}, std::array{Face::y0, Face::z0, Face::z1}));

  // Light comes over the partition along -x, is turned down,
  // and along -x again below the partition's top.
  const auto glass = mirror("mirror", Rgb(0.95));
  add_tilted_mirror(stage, "upper-mirror", {{2.0, 2.85, 1.5}, 0.4, 0.5, 135.0}, glass, iron);
  add_tilted_mirror(stage, "lower-mirror", {{2.0, 1.0, 1.5}, 0.4, 0.5, -45.0}, glass, iron);
  stage.add("upper-rod", iron, box({2.23, 3.18, 1.48}, {2.27, 3.4, 1.52}, std::array{Face::y1}));
  stage.add("lower-post", iron, standing_box({1.73, 0.0, 1.48}, {1.77, 0.66, 1.52}));

  stage.add("red-ball", red, ball({4.9, 2.62, 1.15}, 0.14, 16));
  stage.add("blue-ball", blue, ball({4.6, 2.97, 1.85}, 0.14, 16));
  stage.add("block", ochre, standing_box({4.4, 0.0, 0.5}, {5.1, 0.9, 1.2}));
  return stage;
}

Stage facing_mirrors() {
  Stage stage{"facing-mirrors",
              {},
              {{"main", {-1.75, 1.6, 2.0}, {2.0, 1.05, -0.45}, 55.0, 4.0 / 3.0},
               {"along", {0.0, 1.5, 2.4}, {0.0, 1.1, 0.0}, 75.0, 1.5}}};
  const Point3 low{-2.0, 0.0, -2.5};
  const Point3 high{2.0, 2.8, 2.5};
  add_room(stage, low, high, plaster, boards, std::array{Face::x0, Face::x1, Face::y1});

  const auto glass = mirror("mirror", Rgb(0.9));
  const Rect extent{{0.0, 0.0}, {5.0, 2.8}};
  const Rect opening{{0.3, 0.3}, {4.7, 2.5}};
  const Sheet left{{low.x, 0.0, high.z}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};
  const Sheet right{{high.x, 0.0, low.z}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  stage.add("left", red, wall(left, extent, std::array{opening}));
  stage.add("left-mirror", glass, panel(left, opening, 0.0));
  stage.add("right", blue, wall(right, extent, std::array{opening}));
  stage.add("right-mirror", glass, panel(right, opening, 0.0));

  const Sheet ceiling{{low.x, high.y, low.z}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect lamp{{1.7, 2.2}, {2.3, 2.8}};
  stage.add("ceiling", plaster, wall(ceiling, {{0.0, 0.0}, {4.0, 5.0}}, std::array{lamp}));
  stage.add("lamp", light("lamp", {14.0, 13.0, 11.0}), panel(ceiling, lamp, 0.0));

  stage.add("pedestal", plaster, standing_box({-0.2, 0.0, -0.7}, {0.2, 0.9, -0.3}));
  stage.add("ball", ochre, ball({0.0, 1.11, -0.5}, 0.2, 16));
  const std::array base{Vec2(0.75, 0.35), Vec2(1.2, 0.15), Vec2(1.4, 0.6), Vec2(0.95, 0.8)};
  stage.add("block", red, standing_prism(base, 0.0, 0.55));
  stage.add("column", blue, standing_prism(regular({-1.1, -1.5}, 0.2, 12), 0.0, 1.6));
  return stage;
}

} // namespace meninas::gallery
