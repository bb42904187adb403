#include "tests/support/skies.h"

namespace meninas::test {

RadianceMap map_of(const std::function<Rgb(const Direction&)>& radiance, int width,
                   const MapPlacement& placement) {
  RadianceMap raw;
  raw.name = "sky";
  raw.width = width;
  raw.height = width / 2;
  for (int j = 0; j < raw.height; ++j)
    for (int i = 0; i < raw.width; ++i)
      raw.texels.emplace_back(
          radiance(direction_at(raw, (i + 0.5) / raw.width, (j + 0.5) / raw.height)));
  TexelFaults faults;
  return make_radiance_map(std::move(raw), placement, faults);
}

Environment sky_of(const std::function<Rgb(const Direction&)>& radiance, int width,
                   const MapPlacement& placement) {
  Environment environment;
  environment.map = std::make_shared<const RadianceMap>(map_of(radiance, width, placement));
  return environment;
}

Scene room_with_window(const Material& walls, const Material* pane) {
  Scene scene;
  const auto wall = [&](const char* name, const std::vector<Point3>& corners) {
    add_polygon(scene, name, corners, walls);
  };
  wall("x0", {{0, 0, 0}, {0, 3, 0}, {0, 3, 5}, {0, 0, 5}});
  wall("floor", {{0, 0, 0}, {0, 0, 5}, {4, 0, 5}, {4, 0, 0}});
  wall("ceiling", {{0, 3, 0}, {4, 3, 0}, {4, 3, 5}, {0, 3, 5}});
  wall("z0", {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  wall("z1", {{0, 0, 5}, {0, 3, 5}, {4, 3, 5}, {4, 0, 5}});
  const double y0 = 1.0, y1 = 2.2, z0 = 1.5, z1 = 2.9;
  wall("below", {{4, 0, 0}, {4, 0, 5}, {4, y0, 5}, {4, y0, 0}});
  wall("above", {{4, y1, 0}, {4, y1, 5}, {4, 3, 5}, {4, 3, 0}});
  wall("left", {{4, y0, 0}, {4, y0, z0}, {4, y1, z0}, {4, y1, 0}});
  wall("right", {{4, y0, z1}, {4, y0, 5}, {4, y1, 5}, {4, y1, z1}});
  if (pane)
    add_polygon(scene, "pane", {{4, y0, z0}, {4, y0, z1}, {4, y1, z1}, {4, y1, z0}}, *pane);
  return scene;
}

} // namespace meninas::test
