// A room of textures: tiles that run away into a mirror,
// a paper on the wall, and a screen cut out of a sheet, before the sun.
#include "scenes/gallery/generator/furniture.h"
#include "scenes/gallery/generator/stages.h"

#include <cmath>
#include <numbers>

namespace meninas::gallery {

static const Paint plaster = diffuse("plaster", {0.75, 0.73, 0.7});
static const Paint oak = diffuse("oak", {0.35, 0.24, 0.15});

/// Two by two tiles, light and dark, with grey joints.
static Picture tiles() {
  Picture picture{
      "tiles", 64, 64, {{236, 230, 216, 255}, {84, 56, 44, 255}, {150, 146, 140, 255}}, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool joint = (x + 1) % 32 < 2 || (y + 1) % 32 < 2;
      picture.texels.push_back(static_cast<std::uint8_t>(joint ? 2 : (x / 32 + y / 32) % 2));
    }
  return picture;
}

/// A quarter of a flower; its mirror images make it whole.
static Picture flowers() {
  Picture picture{
      "flowers", 32, 32, {{214, 205, 176, 255}, {92, 122, 96, 255}, {176, 84, 70, 255}}, {}, true};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double u = x + 0.5, v = y + 0.5, r = std::hypot(u, v);
      const double petal = 11.0 + 6.0 * std::cos(8.0 * std::atan2(v, u));
      const bool stem = std::abs(r - 27.0) < 2.5;
      picture.texels.push_back(r < petal ? 2 : stem ? 1 : 0);
    }
  return picture;
}

/// A lattice of bars that cross in stars: the holes are not there.
static Picture holes() {
  Picture picture{"lattice", 32, 32, {{255, 255, 255, 255}, {255, 255, 255, 0}}, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double u = std::abs(x + 0.5 - 16.0), v = std::abs(y + 0.5 - 16.0);
      const bool bar = u > 14.0 || v > 14.0 || std::abs(u - v) < 2.0 || u + v > 26.0;
      picture.texels.push_back(bar ? 0 : 1);
    }
  return picture;
}

static Paint with(Picture picture, Rgb color = Rgb(1.0)) {
  Paint paint = diffuse(picture.name, color);
  paint.picture = std::move(picture);
  return paint;
}

/// Vertex colours that run once round the circle of hues.
static Mesh coloured(Mesh mesh, const Point3& centre) {
  for (const Point3& position : mesh.positions) {
    const double hue = std::atan2(position.z - centre.z, position.x - centre.x);
    const auto part = [&](double at) {
      return 0.5 + 0.45 * std::cos(hue - at * 2.0 * std::numbers::pi / 3.0);
    };
    mesh.colors.emplace_back(part(0.0), part(1.0), part(2.0));
  }
  return mesh;
}

Stage lattice() {
  Stage stage{"lattice",
              {},
              {{"main", {2.9, 1.5, 5.9}, {1.7, 1.0, 0.0}, 55.0, 4.0 / 3.0},
               {"floor", {3.0, 0.6, 5.5}, {1.6, 0.35, 0.0}, 40.0, 1.0}}};
  const Point3 low{0.0, 0.0, 0.0};
  const Point3 high{4.0, 2.8, 6.0};
  add_room(stage, low, high, plaster, plaster, std::array{Face::x0, Face::x1, Face::y0, Face::z0});

  const Sheet floor{{low.x, low.y, high.z}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  stage.add("floor", with(tiles()), papered(room_wall(low, high, Face::y0), floor, 0.8));
  const Sheet right{{high.x, 0.0, low.z}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  stage.add("right", with(flowers()), papered(room_wall(low, high, Face::x1), right, 0.2));

  // The mirror begins at the floor, so that the tiles run on in it.
  const Sheet back{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  const Rect glass{{0.8, 0.0}, {3.2, 2.2}};
  stage.add("back", plaster, wall(back, {{0.0, 0.0}, {4.0, 2.8}}, std::array{glass}));
  stage.add("mirror", mirror("mirror", Rgb(0.92)), panel(back, glass, 0.0));

  // The sun shines through the lattice in the window.
  const Sheet left{{low.x, 0.0, high.z}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};
  const Rect window{{1.8, 0.4}, {4.2, 2.4}};
  stage.add("window-wall", plaster, wall(left, {{0.0, 0.0}, {6.0, 2.8}}, std::array{window}));
  stage.add("reveal", plaster, reveal(left, window, 0.2));
  stage.add("screen", with(holes(), {0.3, 0.2, 0.12}),
            papered(panel(left, window, -0.1), {left.at(1.8, 0.4), left.u, left.v}, 0.4));
  stage.lamps.push_back(
      {"sun", "directional", {60.0, 54.0, 45.0}, {0.0, 0.0, 0.0}, {1.0, -0.8, -0.25}});

  const Sheet ceiling{{low.x, high.y, low.z}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  stage.add("lamp", light("lamp", {9.0, 9.5, 11.0}),
            panel(ceiling, {{1.5, 2.5}, {2.5, 3.5}}, 0.02));
  const Point3 ball_at{2.75, 0.85, 1.9};
  stage.add("pedestal", oak, standing_box({2.5, 0.0, 1.65}, {3.0, 0.5, 2.15}));
  stage.add("ball", diffuse("rainbow", Rgb(0.9)), coloured(ball(ball_at, 0.345, 24), ball_at));
  return stage;
}

} // namespace meninas::gallery
