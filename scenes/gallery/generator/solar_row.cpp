// A row of six panels under a low sun, flat mirrors on the ground before four of them: what mirrors bring to a
// panel is a second sun, below the horizon.
#include "scenes/gallery/generator/shapes.h"
#include "scenes/gallery/generator/stages.h"

#include <cmath>
#include <numbers>

namespace meninas::gallery {

static constexpr double degree = std::numbers::pi / 180.0;
static constexpr double tilt = 50.0 * degree, elevation = 25.0 * degree;
static constexpr double width = 1.0, length = 1.6, pitch = 1.1, foot = 0.3;

/// Facing south, which is +z: its normal is (0, cos tilt, sin tilt).
static void add_panel(Stage& stage, int number) {
  const std::string name = std::to_string(number);
  const double left = pitch * (number - 1);
  const Vec3 up_slope(0.0, std::sin(tilt), -std::cos(tilt));
  const Sheet front{{left, foot, 0.0}, {1.0, 0.0, 0.0}, up_slope};
  const Sheet back{{left + width, foot, 0.0}, {-1.0, 0.0, 0.0}, up_slope};
  const Rect all{{0.0, 0.0}, {width, length}};
  stage.add("panel-" + name, diffuse("cells", {0.05, 0.06, 0.1}), panel(front, all, 0.0));
  stage.add("back-" + name, diffuse("aluminium", Rgb(0.55)), batten(back, all, 0.0, 0.04));
  std::vector<Mesh> posts;
  for (const double x : {left + 0.2, left + width - 0.2}) {
    const Point3 at = front.at(x - left, 1.0, -0.06);
    posts.push_back(standing_box({x - 0.02, 0.0, at.z - 0.05}, {x + 0.02, at.y - 0.04, at.z - 0.01}));
  }
  stage.add("posts-" + name, diffuse("steel", Rgb(0.4)), merged(posts));
}

Stage solar_row() {
  Stage stage{"solar-row",
              {},
              {{"main", {9.6, 2.6, 5.2}, {3.6, 0.55, 0.3}, 40.0, 1.6},
               {"row", {3.2, 3.2, 7.5}, {3.2, 0.5, 0.0}, 45.0, 2.0}}};
  stage.lamps.push_back({"sun",
                         "directional",
                         Rgb(800.0),
                         {0.0, std::sin(elevation), std::cos(elevation)},
                         {0.0, 0.0, 0.0}});
  stage.add("ground", diffuse("gravel", Rgb(0.2)),
            quad({-10.0, 0.0, 10.0}, {16.5, 0.0, 10.0}, {16.5, 0.0, -10.0}, {-10.0, 0.0, -10.0}));
  for (int number = 1; number <= 6; ++number)
    add_panel(stage, number);

  // The sun's image lights the panel from its lower edge, by way of z = 0.5 m, to its upper one, by 2.1 m.
  const Sheet ground{{2.0 * pitch, 0.0, 2.5}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  const Rect all{{0.0, 0.0}, {3.0 * pitch + width, 2.2}};
  stage.add("mirror-bed", diffuse("steel", Rgb(0.4)), batten(ground, all, 0.0, 0.05));
  stage.add("mirror", mirror("mirror", Rgb(0.9)), panel(ground, all, 0.06));
  return stage;
}

} // namespace meninas::gallery
