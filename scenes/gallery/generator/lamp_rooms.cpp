// A room lit by lamps without extent: what they throw by way of mirrors no path tracer finds.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static const Paint plaster = diffuse("plaster", {0.75, 0.73, 0.7});
static const Paint boards = diffuse("boards", {0.5, 0.38, 0.28});
static const Paint oak = diffuse("oak", {0.35, 0.24, 0.15});
static const Paint iron = diffuse("iron", {0.15, 0.15, 0.16});
static const Paint ochre = diffuse("ochre", {0.65, 0.45, 0.15});
static const Paint blue = diffuse("blue", {0.1, 0.2, 0.55});

/// A wall with a window of two panes without glass.
static void add_window(Stage& stage, const Sheet& sheet, const Rect& extent) {
  const std::array panes{Rect{{1.5, 0.9}, {2.15, 2.3}}, Rect{{2.25, 0.9}, {2.9, 2.3}}};
  stage.add("window-wall", plaster, wall(sheet, extent, panes));
  std::vector<Mesh> reveals;
  for (const Rect& pane : panes)
    reveals.push_back(reveal(sheet, pane, 0.2));
  stage.add("reveals", plaster, merged(reveals));
}

Stage sunbeam() {
  Stage stage{"sunbeam",
              {},
              {{"main", {2.2, 1.6, 4.85}, {2.1, 1.2, 0.0}, 62.0, 4.0 / 3.0},
               {"spot", {1.2, 1.7, 3.6}, {2.9, 0.3, 1.4}, 45.0, 1.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{4.0, 2.8, 5.0};
  add_room(stage, low, high, plaster, boards, std::array{Face::x0, Face::z0});
  add_window(stage, {{low.x, 0.0, high.z}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}},
             {{0.0, 0.0}, {5.0, 2.8}});

  // The sun meets a mirror on the table, which throws it at the wall opposite.
  stage.lamps.push_back(
      {"sun", "directional", {110.0, 96.0, 74.0}, {0.0, 0.0, 0.0}, {1.0, -0.72, -0.16}});
  stage.add("table", oak, standing_box({1.35, 0.0, 2.0}, {2.35, 0.45, 2.8}));
  const auto glass = mirror("mirror", Rgb(0.93));
  const Sheet top{{1.35, 0.45, 2.8}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  stage.add("tray-mirror", glass, panel(top, {{0.2, 0.15}, {0.8, 0.65}}, 0.01));
  stage.add("tray", iron, batten(top, {{0.2, 0.15}, {0.8, 0.65}}, 0.0, 0.009));

  // A spot on the ceiling is aimed at a mirror on the wall, and lights the ball by way of it.
  const Sheet back{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Rect opening{{2.3, 0.7}, {3.3, 2.0}};
  stage.add("back", plaster, wall(back, {{0.0, 0.0}, {4.0, 2.8}}, std::array{opening}));
  stage.add("wall-mirror", glass, panel(back, opening, 0.0));
  Lamp spot{"spotlight", "spot", {60.0, 48.0, 30.0}, {2.8, 2.7, 1.2}, {2.8, 1.35, 0.0}};
  spot.inner_cone = 16.0;
  spot.outer_cone = 24.0;
  stage.lamps.push_back(spot);
  stage.add("spot-can", iron, box({2.74, 2.71, 1.14}, {2.86, 2.8, 1.26}, std::array{Face::y1}));
  stage.add("ball", ochre, ball({2.8, 0.25, 1.35}, 0.245, 16));

  // A bare bulb in the corner.
  stage.lamps.push_back({"bulb", "point", {0.9, 0.6, 0.25}, {0.6, 1.45, 0.6}, {0.6, 0.0, 0.7}});
  stage.add("stand", oak, standing_box({0.4, 0.0, 0.4}, {0.8, 1.0, 0.8}));
  stage.add("vase", blue, ball({0.5, 1.12, 0.68}, 0.115, 16));
  return stage;
}

} // namespace meninas::gallery
