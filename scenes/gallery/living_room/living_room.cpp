#include "scenes/gallery/living_room/living_room.h"

#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/living_room/pieces.h"
#include "scenes/gallery/living_room/textures.h"

namespace meninas::gallery {
namespace {

const Point3 low{0.0, 0.0, 0.0};
const Point3 high{5.6, 2.8, 5.6};
const Paint plaster = diffuse("plaster", {0.74, 0.72, 0.67});
const Paint white = diffuse("white-paint", {0.8, 0.79, 0.77});
const Rect window{{2.9, 0.45}, {4.8, 2.35}}; ///< on the left wall, from its front end

Sheet left_wall() { return {{low.x, 0.0, high.z}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}}; }

/// A wall round one opening, mitred: its outer edges stay whole, as those of its neighbours are.
Mesh wall_around(const Sheet& sheet, const Rect& outer, const Rect& inner) {
  const auto corner = [&](const Rect& rect, int k) {
    return sheet.at(k == 1 || k == 2 ? rect.high.x : rect.low.x, k >= 2 ? rect.high.y : rect.low.y);
  };
  std::vector<Mesh> sides;
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    sides.push_back(
        quad(corner(outer, k), corner(outer, next), corner(inner, next), corner(inner, k)));
  }
  return merged(sides);
}

/// Boards round the room, apart from one another, and from the walls, by half a millimetre.
void add_skirting(Stage& stage) {
  constexpr double depth = 0.014, gap = 0.0005, top = 0.09;
  const double across = depth + 2.0 * gap;
  stage.add(
      "skirting", white,
      merged(std::array{
          plain_box({gap, 0.0, gap}, {gap + depth, top, high.z - gap}),
          plain_box({high.x - gap - depth, 0.0, gap}, {high.x - gap, top, high.z - gap}),
          plain_box({across, 0.0, gap}, {high.x - across, top, gap + depth}),
          plain_box({across, 0.0, high.z - gap - depth}, {0.75, top, high.z - gap}),
          plain_box({1.85, 0.0, high.z - gap - depth}, {high.x - across, top, high.z - gap})}));
}

void add_shell(Stage& stage) {
  add_room(stage, low, high, plaster, plaster, std::array{Face::x0, Face::y0, Face::y1});
  stage.add("ceiling", white, room_wall(low, high, Face::y1));
  Mesh floor = room_wall(low, high, Face::y0);
  for (const Point3& p : floor.positions)
    floor.texcoords.emplace_back(p.x / 1.12, p.z / 2.8);
  stage.add("floor", textured("planks", planks()), floor);

  const Sheet left = left_wall();
  stage.add("left", plaster, wall_around(left, {{0.0, 0.0}, {high.z, high.y}}, window));
  stage.add("reveal", white, reveal(left, window, 0.22));
  add_skirting(stage);
}

/// Two wings of six panes, without glass: bars that meet end to face.
void add_window(Stage& stage) {
  constexpr double bar = 0.045, gap = 0.0005, x = -0.16;
  const double z0 = high.z - window.high.x, z1 = high.z - window.low.x;
  const double y0 = window.low.y, y1 = window.high.y, middle = 0.5 * (z0 + z1);
  std::vector<Mesh> bars;
  const auto add = [&](double from_y, double to_y, double from_z, double to_z, double depth) {
    bars.push_back(
        plain_box({x - depth, from_y + gap, from_z + gap}, {x + depth, to_y - gap, to_z - gap}));
  };
  add(y0, y1, z0, z0 + bar, 0.03);
  add(y0, y1, z1 - bar, z1, 0.03);
  add(y0, y1, middle - bar, middle + bar, 0.03);
  for (const auto& [from, to] :
       {std::pair(z0 + bar, middle - bar), std::pair(middle + bar, z1 - bar)}) {
    add(y0, y0 + bar, from, to, 0.03);
    add(y1 - bar, y1, from, to, 0.03);
    const double half = 0.5 * (from + to), thin = 0.012;
    add(y0 + bar, y1 - bar, half - thin, half + thin, 0.015);
    for (const double part : {1.0 / 3.0, 2.0 / 3.0}) {
      const double y = std::lerp(y0, y1, part);
      add(y - thin, y + thin, from, half - thin, 0.015);
      add(y - thin, y + thin, half + thin, to, 0.015);
    }
  }
  stage.add("window-bars", white, merged(bars));
  stage.add("window-sill", white,
            rounded_box({0.0005, y0 - 0.035, z0}, {0.06, y0 - 0.001, z1}, 0.01, 2));
}

void add_wall_mirror(Stage& stage) {
  const Sheet back{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Rect glass{{1.7, 1.12}, {3.7, 2.26}};
  stage.add("wall-mirror", mirror("silvered", {0.92, 0.92, 0.91}), panel(back, glass, 0.02));
  stage.add("wall-mirror-frame", diffuse("gilt", {0.55, 0.4, 0.17}),
            frame(back, glass, {0.08, 0.045, 0.02}));
  stage.add("wall-mirror-bead", diffuse("gilt", {0.55, 0.4, 0.17}),
            merged(std::array{rounded_box({1.625, 2.265, 0.046}, {3.775, 2.335, 0.07}, 0.01, 2),
                              rounded_box({1.625, 1.045, 0.046}, {3.775, 1.115, 0.07}, 0.01, 2),
                              rounded_box({1.625, 1.12, 0.046}, {1.695, 2.26, 0.07}, 0.01, 2),
                              rounded_box({3.705, 1.12, 0.046}, {3.775, 2.26, 0.07}, 0.01, 2)}));
}

/// Behind the main camera: seen in the mirrors alone.
void add_front_and_right(Stage& stage) {
  const Sheet front{{high.x, 0.0, high.z}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Rect door{{3.85, 0.002}, {4.75, 2.1}};
  stage.add("door", diffuse("door", {0.36, 0.42, 0.4}), batten(front, door, 0.0, 0.03));
  add_bookcase(stage, "second-bookcase", {{2.6, 0.0, high.z - 0.02}, 180.0}, 5000);

  const Sheet right{{high.x, 0.0, low.z}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  const Rect canvas{{2.3, 1.2}, {3.7, 2.1}};
  Mesh picture = panel(right, canvas, 0.02);
  picture.texcoords = {{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}};
  stage.add("painting", textured("painting", painting()), picture);
  stage.add("painting-frame", dark_wood(), box_mapped(frame(right, canvas, {0.06, 0.04, 0.02})));
  stage.add("sideboard", wood(),
            merged(std::array{rounded_box({5.14, 0.14, 2.2}, {5.58, 0.74, 3.8}, 0.012, 3),
                              rounded_box({5.12, 0.741, 2.18}, {5.582, 0.77, 3.82}, 0.012, 3),
                              rounded_box({5.16, 0.0, 2.24}, {5.22, 0.139, 2.3}, 0.01, 3),
                              rounded_box({5.16, 0.0, 3.7}, {5.22, 0.139, 3.76}, 0.01, 3),
                              rounded_box({5.5, 0.0, 2.24}, {5.56, 0.139, 2.3}, 0.01, 3),
                              rounded_box({5.5, 0.0, 3.7}, {5.56, 0.139, 3.76}, 0.01, 3)}));
}

} // namespace

Stage living_room() {
  Stage stage{"living-room",
              {},
              {{"main", {4.3, 1.5, 5.2}, {2.35, 0.95, 0.8}, 44.0, 16.0 / 9.0},
               {"mirror", {3.2, 1.5, 3.6}, {2.7, 1.55, 0.0}, 50.0, 4.0 / 3.0},
               {"table", {3.6, 1.0, 3.1}, {2.65, 0.5, 1.9}, 40.0, 4.0 / 3.0},
               {"window", {4.6, 1.4, 2.4}, {0.0, 1.1, 1.9}, 55.0, 4.0 / 3.0}}};
  add_shell(stage);
  add_window(stage);
  add_curtains(stage, high.z - window.high.x, high.z - window.low.x);
  add_wall_mirror(stage);
  add_front_and_right(stage);

  constexpr double on_rug = 0.0125;
  Mesh rug = plain_box({1.3, 0.0, 1.05}, {4.0, 0.012, 2.95});
  for (std::size_t k = 0; k < rug.positions.size(); ++k)
    rug.texcoords[k] = {(rug.positions[k].x - 1.3) / 2.7, (rug.positions[k].z - 1.05) / 1.9};
  stage.add("rug", textured("carpet", carpet()), rug);

  add_seat(stage, {"sofa", 3, {0.36, 0.42, 0.38}, true}, {{2.7, 0.0, 0.5}});
  add_seat(stage, {"armchair", 1, {0.5, 0.3, 0.2}, false}, {{4.35, 0.0, 2.75}, -105.0});
  add_bookcase(stage, "bookcase", {{4.78, 0.0, 0.02}}, 0);
  add_tea_table(stage, {{2.65, on_rug, 1.95}});
  add_plant(stage, {{0.62, 0.0, 2.15}}, 400);
  add_standing_mirror(stage, {{0.72, 0.0, 0.62}, 48.0});
  add_floor_lamp(stage, {{3.97, 0.0, 0.62}});
  add_lantern(stage, {2.65, high.y, 2.3});

  stage.lamps.push_back(
      {"sun", "directional", {60.0, 53.0, 43.0}, {0.0, 0.0, 0.0}, {1.0, -0.75, -0.12}});
  return stage;
}

} // namespace meninas::gallery
