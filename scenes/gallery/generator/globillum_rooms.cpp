// The mirror rooms of the global illumination tests of 1992 (posted by G. Ward to the list `globillum`):
// 10 x 6 x 3 m, two partitions, one lamp of radiosity 31.416 W/m^2, and walls that are mirrors.
// A plan's (x, y, height) stands at (x, height, -y).
#include "scenes/gallery/generator/shapes.h"
#include "scenes/gallery/generator/stages.h"

#include <algorithm>

namespace meninas::gallery {

static constexpr Point3 low{0.0, 0.0, -6.0};
static constexpr Point3 high{10.0, 3.0, 0.0};

static const Paint walls = diffuse("walls", Rgb(0.5));

/// Named by the plan: x0 is the wall x = 0, y6 the wall y = 6.
struct Wall {
  const char* name;
  Face face;
};
static constexpr std::array sides{Wall{"wall-x0", Face::x0}, Wall{"wall-x10", Face::x1},
                                  Wall{"wall-y0", Face::z1}, Wall{"wall-y6", Face::z0}};

/// Around the lamp, mitred from its corners to those of the room: no corner lies on another's edge.
static void add_ceiling(Stage& stage) {
  const Sheet above{{low.x, high.y, low.z}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  const std::array outer{Vec2(0.0, 0.0), Vec2(10.0, 0.0), Vec2(10.0, 6.0), Vec2(0.0, 6.0)};
  const std::array inner{Vec2(4.75, 2.75), Vec2(5.25, 2.75), Vec2(5.25, 3.25), Vec2(4.75, 3.25)};
  const auto at = [&](const Vec2& p) { return above.at(p.x, p.y); };
  std::vector<Mesh> parts;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    parts.push_back(quad(at(outer[k]), at(outer[next]), at(inner[next]), at(inner[k])));
  }
  stage.add("ceiling", diffuse("ceiling", Rgb(0.7)), merged(parts));
  stage.add("lamp", light("lamp", Rgb(10.0)), panel(above, {inner[0], inner[2]}, 0.0));
}

static Stage room(std::string name, std::vector<View> views, std::span<const Face> mirrors) {
  Stage stage{std::move(name), {}, std::move(views)};
  stage.add("floor", diffuse("floor", Rgb(0.3)), room_wall(low, high, Face::y0));
  add_ceiling(stage);
  for (const auto& [wall_name, face] : sides) {
    const bool is_mirror = std::ranges::find(mirrors, face) != mirrors.end();
    stage.add(wall_name, is_mirror ? mirror("mirror", Rgb(0.75)) : walls,
              room_wall(low, high, face));
  }

  // Full height, from a wall to the middle of the room.
  stage.add("partition-x3", walls,
            box({3.0, 0.0, -6.0}, {3.1, 3.0, -3.0}, std::array{Face::y0, Face::y1, Face::z0}));
  stage.add("partition-x7", walls,
            box({7.0, 0.0, -3.0}, {7.1, 3.0, 0.0}, std::array{Face::y0, Face::y1, Face::z1}));
  return stage;
}

/// From before the wall y = 6, whose back is not there, to the mirror y = 0.
static const View from_y6{"main", {5.15, 1.8, -9.0}, {4.95, 1.2, 0.0}, 43.0, 1.6};

Stage globillum_1() {
  return room("globillum-1", {from_y6, {"inside", {9.5, 1.7, -5.6}, {4.0, 1.2, 0.0}, 65.0, 1.5}},
              std::array{Face::z1});
}

/// Four rooms meet where the mirrors do.
Stage globillum_2() {
  return room("globillum-2",
              {{"main", {2.6, 1.6, -2.7}, {0.0, 1.3, 0.0}, 75.0, 1.6},
               {"inside", {9.6, 1.7, -5.6}, {2.0, 1.2, -0.6}, 62.0, 1.5}},
              std::array{Face::z1, Face::x0});
}

Stage globillum_3() {
  return room("globillum-3", {from_y6, {"inside", {5.9, 1.6, -5.6}, {4.7, 1.3, 0.0}, 70.0, 1.5}},
              std::array{Face::z1, Face::z0});
}

} // namespace meninas::gallery
