// Rooms with what is between diffuse and mirror: glass, varnish, and metals of every roughness.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static const Paint plaster = diffuse("plaster", {0.72, 0.7, 0.66});
static const Paint stone = diffuse("stone", {0.45, 0.43, 0.4});

/// The room's ceiling with a lamp let into it.
static void add_ceiling(Stage& stage, const Point3& high, const Rect& opening, const Paint& lamp) {
  const Sheet ceiling{{0.0, high.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  stage.add("ceiling", plaster, wall(ceiling, {{0.0, 0.0}, {high.x, high.z}}, std::array{opening}));
  stage.add("lamp", lamp, panel(ceiling, opening, 0.0));
}

Stage glass_screen() {
  Stage stage{"glass-screen",
              {},
              {{"main", {2.4, 1.35, 3.85}, {1.2, 0.75, 1.3}, 55.0, 4.0 / 3.0},
               {"behind", {0.5, 1.4, 0.4}, {2.6, 0.8, 3.2}, 55.0, 1.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{3.6, 2.5, 4.0};
  add_room(stage, low, high, plaster, coated("varnished-floor", {0.4, 0.24, 0.13}, 0.0),
           std::array{Face::y1});
  add_ceiling(stage, high, {{0.6, 0.7}, {1.2, 1.3}}, light("lamp", {15.0, 13.0, 10.0}));

  // The lamp is behind the screen: what is in front of it is lit through coloured glass.
  const Sheet screen{{0.0, 0.0, 1.9}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  stage.add("clear-pane", glass("clear-glass", Rgb(1.0)),
            panel(screen, {{0.2, 0.05}, {1.2, 2.1}}, 0.0));
  stage.add("green-pane", glass("green-glass", {0.35, 0.9, 0.5}),
            panel(screen, {{1.25, 0.05}, {2.25, 2.1}}, 0.0));
  const auto oak = diffuse("oak", {0.35, 0.24, 0.15});
  stage.add("posts", oak,
            merged(std::array{box({0.15, 0.0, 1.875}, {0.2, 2.15, 1.925}),
                              box({1.2, 0.0, 1.875}, {1.25, 2.15, 1.925}),
                              box({2.25, 0.0, 1.875}, {2.3, 2.15, 1.925})}));
  stage.add("red-block", diffuse("red", {0.6, 0.12, 0.08}),
            standing_box({0.5, 0.0, 0.9}, {1.0, 0.9, 1.4}));
  stage.add("blue-block", diffuse("blue", {0.12, 0.2, 0.55}),
            standing_box({0.4, 0.0, 2.5}, {0.8, 0.5, 2.9}));
  stage.add("candle", light("candle", {24.0, 15.0, 7.0}),
            standing_box({0.55, 0.5, 2.65}, {0.65, 0.7, 2.75}));
  return stage;
}

/// Coloured bars on the wall behind, `height` metres high.
static void add_bars(Stage& stage, double height) {
  const std::array colours{Rgb(0.65, 0.12, 0.1), Rgb(0.75, 0.6, 0.12), Rgb(0.12, 0.3, 0.6)};
  const Sheet back{{0.0, 0.0, 0.02}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  for (int k = 0; k < 12; ++k) {
    const double s = 0.15 + 0.32 * k;
    const auto paint =
        diffuse("bar-" + std::to_string(k % 3), colours[static_cast<std::size_t>(k % 3)]);
    stage.add("bar-" + std::to_string(k), paint,
              batten(back, {{s, 0.0}, {s + 0.16, height}}, -0.02, 0.0));
  }
}

Stage glass_solids() {
  Stage stage{"glass-solids", {}, {{"main", {2.0, 1.35, 3.9}, {2.0, 0.85, 1.2}, 45.0, 4.0 / 3.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{4.0, 2.6, 4.2};
  add_room(stage, low, high, plaster, stone, std::array{Face::y1});
  add_ceiling(stage, high, {{1.4, 1.6}, {2.6, 2.4}}, light("lamp", {9.0, 8.4, 7.5}));
  add_bars(stage, 1.9);

  // On a table, a hair above it: nothing is pressed into the wood.
  constexpr double top = 0.55, gap = 0.004;
  stage.add("table", diffuse("oak", {0.35, 0.24, 0.15}),
            standing_box({0.6, 0.0, 1.0}, {3.4, top, 1.9}));
  stage.add("ball", solid_glass("clear", Rgb(0.98), 0.6),
            ball({1.1, top + gap + 0.3, 1.45}, 0.3, 48));
  stage.add("block", solid_glass("amber", {0.9, 0.55, 0.15}, 0.4),
            box({1.75, top + gap, 1.25}, {2.15, top + gap + 0.6, 1.65}));
  stage.add("slab", solid_glass("bottle", {0.45, 0.85, 0.5}, 0.12),
            turned(box({2.5, top + gap, 1.4}, {3.1, top + gap + 0.7, 1.52}), {2.8, 0.0, 1.46},
                   {0.0, 1.0, 0.0}, 35.0));
  return stage;
}

Stage roughness_sweep() {
  Stage stage{
      "roughness-sweep", {}, {{"main", {2.0, 1.5, 4.4}, {2.0, 0.45, 1.2}, 50.0, 4.0 / 3.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{4.0, 2.6, 4.6};
  add_room(stage, low, high, plaster, stone, std::array{Face::y1});
  add_ceiling(stage, high, {{1.4, 1.6}, {2.6, 2.4}}, light("lamp", {9.0, 8.4, 7.5}));

  // Bars on the wall,
  // and strips before them that blur their reflections the more the further away they are.
  add_bars(stage, 1.1);
  const std::array roughness{0.0, 0.1, 0.2, 0.35, 0.6};
  for (std::size_t k = 0; k < roughness.size(); ++k) {
    const double x = 0.2 + 0.6 * double(k);
    const auto name = "metal-" + std::to_string(static_cast<int>(100.0 * roughness[k]));
    stage.add(name, metal(name, Rgb(0.85, 0.83, 0.8), roughness[k]),
              standing_box({x, 0.0, 0.3}, {x + 0.55, 0.02, 3.3}));
  }
  stage.add("varnish", coated("varnish", {0.3, 0.16, 0.08}, 0.0),
            standing_box({3.2, 0.0, 0.3}, {3.75, 0.02, 3.3}));
  return stage;
}

} // namespace meninas::gallery
