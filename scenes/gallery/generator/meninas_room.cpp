// The painter's room, after the painting (Velazquez, 1656): a deep room seen from
// where the royal couple stands, the couple only in the plane mirror on the back wall,
// a bright door, windows in deep reveals on the right, the back of a large canvas on the left.
// A low sun comes in behind the viewer; a silver tray throws it onto the back wall.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/meninas_figures.h"
#include "scenes/gallery/generator/stages.h"

namespace meninas::gallery {

static constexpr double left_x = -3.0, right_x = 2.6, height = 4.4, rear_z = 10.4;

static const Paint plaster = diffuse("plaster", {0.5, 0.4, 0.28});
static const Paint pale = diffuse("pale plaster", {0.72, 0.66, 0.54});
static const Paint dark_wood = diffuse("dark wood", {0.1, 0.065, 0.04});
static const Paint wood = diffuse("wood", {0.4, 0.27, 0.15});
static const Paint silver = mirror("silver", {0.93, 0.92, 0.9});

static const Sheet back_wall{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
static const Sheet right_wall{{right_x, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
static const Sheet rear_wall{{0.0, 0.0, rear_z}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};

static constexpr double frame_width = 0.12;
static const Rect mirror_rect{{-1.0, 1.2}, {0.1, 2.6}};
static const Rect door{{0.95, 0.0}, {1.85, 2.3}};
static const Rect left_picture{{-2.18, 3.07}, {-0.24, 4.03}};
static const Rect right_picture{{0.34, 3.07}, {2.18, 4.03}};
static const Rect sun_window{{9.25, 2.9}, {10.15, 3.8}};

// The sun is thrown by the tray to this place on the back wall, between canvas and mirror.
static constexpr Point3 tray_centre{-0.06, 0.97, 3.56};
static constexpr Point3 sun_patch{-1.6, 2.5, 0.0};

static void add_shell(Stage& stage) {
  constexpr Point3 low{left_x, 0.0, 0.0}, high{right_x, height, rear_z};
  constexpr int boards = 10;
  std::array<std::vector<Mesh>, 2> tones;
  for (int k = 0; k < boards; ++k) {
    const auto x = [&](int i) { return left_x + (right_x - left_x) * i / boards; };
    tones[k % 2].push_back(
        quad({x(k), 0.0, rear_z}, {x(k + 1), 0.0, rear_z}, {x(k + 1), 0.0, 0.0}, {x(k), 0.0, 0.0}));
  }
  stage.add("floor", diffuse("boards", {0.42, 0.3, 0.19}), merged(tones[0]));
  stage.add("floor.dark", diffuse("dark boards", {0.35, 0.245, 0.15}), merged(tones[1]));
  stage.add("ceiling", diffuse("ceiling", {0.48, 0.41, 0.31}), room_wall(low, high, Face::y1));
  stage.add("left", plaster, room_wall(low, high, Face::x0));
  stage.add("rear", plaster, room_wall(low, high, Face::z1));

  // What hangs on the wall or opens it is cut out of it:
  // no part of the wall lies hidden behind a frame.
  const std::array holes{grown(mirror_rect, frame_width), grown(left_picture, frame_width),
                         grown(right_picture, frame_width), door};
  stage.add("back", plaster, wall(back_wall, {{left_x, 0.0}, {right_x, height}}, holes));

  const std::array hooks{Vec2(0.0, -0.42), Vec2(0.045, -0.38), Vec2(0.012, -0.34),
                         Vec2(0.012, 0.0)};
  stage.add("hooks", dark_wood,
            merged(std::array{lathe({0.05, height, 0.9}, hooks, 6),
                              lathe({0.05, height, 2.1}, hooks, 6)}));
}

static void add_windows(Stage& stage) {
  const std::array windows{Rect{{0.95, 1.2}, {1.85, 3.6}}, Rect{{3.0, 1.2}, {3.9, 3.6}},
                           Rect{{5.05, 1.2}, {5.95, 3.6}}};
  std::vector<Mesh> reveals, panes;
  for (const auto& window : windows) {
    reveals.push_back(reveal(right_wall, window, 0.45));
    panes.push_back(panel(right_wall, window, -0.45));
  }
  stage.add("right", plaster,
            wall(right_wall, {{0.0, 0.0}, {rear_z, height}},
                 std::array{windows[0], windows[1], windows[2], sun_window}));
  stage.add("window-reveals", diffuse("oak", {0.3, 0.23, 0.15}), merged(reveals));
  stage.add("windows", light("sky", {6.5, 6.7, 6.9}), merged(panes));

  // Found backwards: from the patch to the tray, mirrored up, and out through the window.
  const auto to_sun =
      glm::normalize(Vec3(tray_centre.x - sun_patch.x, sun_patch.y - tray_centre.y, tray_centre.z));
  const auto u = glm::normalize(glm::cross(Vec3(0.0, 1.0, 0.0), -to_sun));
  const Sheet sun{tray_centre + 11.5 * to_sun, u, glm::cross(-to_sun, u)};
  stage.add("sun", light("sun", {4400.0, 3600.0, 2600.0}),
            panel(sun, {Vec2(-0.25), Vec2(0.25)}, 0.0));
}

/// A frame with a dark landscape and one light shape in it.
static void add_picture(Stage& stage, const std::string& name, const Rect& inside,
                        const Rect& shape, const Rgb& ground, const Rgb& figure) {
  const Moulding moulding{frame_width, 0.06, 0.02};
  const Sheet canvas{back_wall.at(0.0, 0.0, moulding.rebate), back_wall.u, back_wall.v};
  stage.add(name + ".frame", dark_wood, frame(back_wall, inside, moulding));
  stage.add(name, diffuse(name, ground), wall(canvas, inside, std::array{shape}));
  stage.add(name + ".figure", diffuse(name + ".figure", figure), panel(canvas, shape, 0.0));
}

static void add_back_wall(Stage& stage) {
  stage.add("mirror", silver, panel(back_wall, mirror_rect, 0.02));
  stage.add("mirror.frame", diffuse("ebony", {0.05, 0.035, 0.03}),
            frame(back_wall, mirror_rect, {frame_width, 0.08, 0.02}));
  add_picture(stage, "left-picture", left_picture, {{-1.5, 3.2}, {-1.05, 3.75}}, {0.13, 0.12, 0.08},
              {0.3, 0.2, 0.12});
  add_picture(stage, "right-picture", right_picture, {{0.8, 3.3}, {1.7, 3.7}}, {0.12, 0.1, 0.07},
              {0.24, 0.22, 0.15});
}

/// A passage with stairs behind the door, lit from above, and a man who looks back from it.
static void add_passage(Stage& stage) {
  constexpr Point3 low{0.7, 0.0, -2.6}, high{2.1, 2.6, -0.3};
  stage.add("door-reveal", dark_wood, reveal(back_wall, door, 0.3));
  const Sheet inside{{0.0, 0.0, high.z}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Rect seen_from_inside{{-door.high.x, door.low.y}, {-door.low.x, door.high.y}};
  std::vector<Mesh> walls{
      wall(inside, {{-high.x, low.y}, {-low.x, high.y}}, std::array{seen_from_inside})};
  for (const auto face : {Face::x0, Face::x1, Face::z0})
    walls.push_back(room_wall(low, high, face));

  const Sheet ceiling{{0.0, high.y, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const Rect opening{{0.9, -2.4}, {1.9, -1.5}};
  walls.push_back(wall(ceiling, {{low.x, low.z}, {high.x, high.z}}, std::array{opening}));
  stage.add("passage", pale, merged(walls));
  stage.add("passage-light", light("skylight", {32.0, 29.0, 23.0}), panel(ceiling, opening, 0.0));

  // Three steps from wall to wall.
  const std::array<double, 5> edges{high.z, -0.9, -1.3, -1.7, low.z};
  std::vector<Mesh> stairs;
  for (int k = 0; k < 4; ++k) {
    const auto y = 0.18 * k, front = edges[k], back = edges[k + 1];
    stairs.push_back(
        quad({low.x, y, front}, {high.x, y, front}, {high.x, y, back}, {low.x, y, back}));
    if (k < 3)
      stairs.push_back(quad({low.x, y, back}, {high.x, y, back}, {high.x, y + 0.18, back},
                            {low.x, y + 0.18, back}));
  }
  stage.add("stairs", wood, merged(stairs));
  add_figure(stage, {"chamberlain",
                     {1.52, 0.36, -1.5},
                     1.65,
                     Dress::cloak,
                     {0.05, 0.045, 0.04},
                     {0.06, 0.04, 0.03}});

  const Point3 hinge{1.89, 0.0, 0.03};
  const auto leaf = box({hinge.x, 0.02, hinge.z}, {hinge.x + 0.68, 2.25, hinge.z + 0.045});
  stage.add("door", wood, turned(leaf, hinge, {0.0, 1.0, 0.0}, -14.0));
}

/// The canvas from behind:
/// cloth between stretcher bars, the painted side away from the viewer, on an easel.
static void add_canvas(Stage& stage) {
  constexpr Point3 left{-2.9, 0.45, 3.3}, right{-1.45, 0.45, 2.4};
  const auto u = glm::normalize(right - left);
  const Sheet sheet{left, u, {0.0, 1.0, 0.0}};
  const auto width = glm::distance(left, right);
  const Rect inside{{0.12, 0.12}, {width - 0.12, 3.08}};
  const Rect crossbar{{inside.low.x, 1.5}, {inside.high.x, 1.6}};
  const Sheet cloth{sheet.at(0.0, 0.0, 0.02), u, sheet.v};

  stage.add("canvas.cloth", diffuse("raw linen", {0.5, 0.41, 0.29}),
            wall(cloth, inside, std::array{crossbar}));
  stage.add("canvas.stretcher", wood,
            merged(std::array{frame(sheet, inside, {0.12, 0.07, 0.02}),
                              batten(cloth, crossbar, 0.0, 0.04)}));
  const Sheet painted{right, -u, sheet.v};
  stage.add("canvas.painted", diffuse("primed canvas", {0.6, 0.52, 0.4}),
            panel(painted, {{0.0, 0.0}, {width, 3.2}}, 0.0));

  const auto foot = [&](double s, double off) { return Point3(sheet.at(s, -0.44, off)); };
  stage.add("easel", diffuse("easel", {0.3, 0.19, 0.1}),
            merged(std::array{bar(foot(0.95, 0.6), sheet.at(1.05, 3.0, 0.13), 0.07),
                              bar(foot(1.55, 0.5), sheet.at(1.25, 3.0, 0.13), 0.07),
                              bar(sheet.at(0.9, -0.06, 0.05), sheet.at(1.75, -0.06, 0.05), 0.08)}));
}

static void add_tray(Stage& stage) {
  constexpr Vec3 half{0.27, 0.0, 0.27};
  constexpr Vec3 thickness{0.0, 0.015, 0.0};
  const Sheet top{
      tray_centre - half + Vec3(0.0, 0.0, 2.0 * half.z), {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  stage.add("tray", silver, panel(top, {Vec2(0.0), {2.0 * half.x, 2.0 * half.z}}, 0.0));
  stage.add("tray.back", diffuse("pewter", {0.35, 0.34, 0.32}),
            box(tray_centre - half - thickness, tray_centre + half, std::array{Face::y1}));
  stage.add("cup", diffuse("red clay", {0.5, 0.14, 0.07}),
            lathe(tray_centre + Vec3(0.1, 0.0, -0.1),
                  std::array{Vec2(0.02, 0.0), Vec2(0.045, 0.05), Vec2(0.03, 0.09), Vec2(0.0, 0.1)},
                  8));
}

static void add_household(Stage& stage) {
  const Figure infanta{"infanta",         {0.3, 0.0, 3.3},    1.22,
                       Dress::wide_skirt, {0.72, 0.68, 0.58}, {0.6, 0.42, 0.2}};
  const Figure maid{"maid-left",       {-0.66, 0.0, 3.42}, 1.15,
                    Dress::wide_skirt, {0.22, 0.27, 0.2},  {0.17, 0.1, 0.06}};
  const Figure painter{"painter",    {-1.3, 0.0, 1.9},    1.75,
                       Dress::cloak, {0.09, 0.075, 0.07}, {0.08, 0.05, 0.03}};
  for (const auto& figure : {infanta, maid, painter})
    add_figure(stage, figure);
  add_figure(
      stage,
      {"maid-right", {1.12, 0.0, 2.85}, 1.45, Dress::skirt, {0.3, 0.32, 0.36}, {0.16, 0.1, 0.06}});
  add_figure(
      stage,
      {"attendant", {1.22, 0.0, 3.75}, 1.2, Dress::skirt, {0.12, 0.15, 0.24}, {0.14, 0.08, 0.05}});
  add_arms(stage, infanta, {0.02, 0.66, 3.5}, {0.6, 0.62, 3.42});
  add_arms(stage, maid, {-0.36, 0.95, 3.6}, {-0.33, 0.97, 3.45});
  add_arms(stage, painter, {-1.45, 1.15, 2.2}, {-1.05, 1.2, 2.1});
  add_dog(stage, {0.98, 0.0, 4.2});
}

/// What stands behind the viewer and only the mirror shows.
static void add_royal_couple(Stage& stage) {
  constexpr double dais = 1.05;
  stage.add("dais", diffuse("carpet", {0.4, 0.1, 0.07}),
            standing_box({-2.2, 0.0, 7.9}, {0.4, dais, 9.3}));
  add_figure(stage, {"queen",
                     {-1.28, dais, 8.4},
                     1.75,
                     Dress::skirt,
                     {0.66, 0.56, 0.46},
                     {0.3, 0.17, 0.08},
                     Gaze::rear});
  add_figure(stage, {"king",
                     {-0.5, dais, 8.4},
                     1.9,
                     Dress::cloak,
                     {0.14, 0.12, 0.12},
                     {0.45, 0.3, 0.14},
                     Gaze::rear});

  constexpr int folds = 10;
  std::vector<Mesh> curtain;
  for (int k = 0; k < folds; ++k) {
    const auto s = [](int i) { return -0.8 + 0.36 * i; };
    const auto off = [](int i) { return i % 2 == 0 ? 0.05 : 0.2; };
    curtain.push_back(
        quad(rear_wall.at(s(k), 0.52, off(k)), rear_wall.at(s(k + 1), 0.52, off(k + 1)),
             rear_wall.at(s(k + 1), 4.2, off(k + 1)), rear_wall.at(s(k), 4.2, off(k))));
  }
  stage.add("curtain", diffuse("curtain", {0.5, 0.07, 0.05}), merged(curtain));

  // A light in front of the couple, turned away from the room, above what the mirror shows.
  const auto toward = glm::normalize(Vec3(0.0, -2.2, 1.6));
  const Sheet lamp{{-0.9, 4.1, 7.6}, {1.0, 0.0, 0.0}, glm::cross(toward, Vec3(1.0, 0.0, 0.0))};
  stage.add("couple-light", light("couple light", {26.0, 23.0, 18.0}),
            panel(lamp, {{-0.7, -0.25}, {0.7, 0.25}}, 0.0));
}

Stage meninas_room() {
  Stage stage{"meninas",
              {},
              {{"main", {-0.1, 1.6, 7.2}, {-0.1, 1.6, 0.0}, 60.0, 0.9},
               {"mirror", {-0.1, 1.6, 3.4}, {-0.45, 1.9, 0.0}, 36.0, 1.0},
               {"couple", {-0.6, 1.9, 4.2}, {-0.9, 1.7, 9.2}, 50.0, 1.0}}};
  add_shell(stage);
  add_windows(stage);
  add_back_wall(stage);
  add_passage(stage);
  add_canvas(stage);
  add_tray(stage);
  add_household(stage);
  add_royal_couple(stage);
  return stage;
}

} // namespace meninas::gallery
