#include "tests/mirror/glowing_room.h"

namespace meninas::test {

GlowingRoom glowing(Scene scene, const WorldSettings& settings) {
  GlowingRoom room;
  room.scene = std::move(scene);
  room.surfaces = find_surfaces(room.scene);
  room.mirrors = find_mirrors(room.scene, room.surfaces);
  room.worlds = mirror_worlds(room.mirrors, settings);
  for (const Patch& patch : room.surfaces.patches) {
    if (is_mirror(room.scene.materials[index(patch.material)]))
      continue;
    const Surface& surface = room.surfaces.surfaces[index(patch.surface)];
    const auto corners = polygon_of(patch);
    room.emitters.push_back({{corners.begin(), corners.end()}, surface.plane, surface.plane_class,
                             Rgb(1.0), patch.area});
  }
  return room;
}

Scene room_with_mirrors(const std::array<bool, 6>& is_mirror_wall) {
  Scene scene;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k)
    walls[k] = is_mirror_wall[k] ? mirror(1.0) : diffuse(0.0, 1.0);
  add_room(scene, Point3(0.0), {1.0, 1.5, 2.0}, walls);
  return scene;
}

Scene room_with_mirror_in_wall() {
  Scene scene = room_with_mirrors({});
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  const auto piece = [](double y0, double z0, double y1, double z1) -> std::vector<Point3> {
    return {{0, y0, z1}, {0, y0, z0}, {0, y1, z0}, {0, y1, z1}};
  };
  add_polygon(scene, "mirror", piece(0.3, 0.2, 0.9, 1.2), mirror(1.0));
  add_polygon(scene, "below", piece(0.0, 0.0, 0.3, 2.0), diffuse(0.0, 1.0));
  add_polygon(scene, "above", piece(0.9, 0.0, 1.5, 2.0), diffuse(0.0, 1.0));
  add_polygon(scene, "left", piece(0.3, 0.0, 0.9, 0.2), diffuse(0.0, 1.0));
  add_polygon(scene, "right", piece(0.3, 1.2, 0.9, 2.0), diffuse(0.0, 1.0));
  return scene;
}

Scene room_with_wedge() {
  Scene scene = room_with_mirrors({});
  add_polygon(scene, "wedge", {{0.5, 0.0, 0.0}, {0.5, 1.5, 0.0}, {0.0, 1.5, 0.7}, {0.0, 0.0, 0.7}},
              mirror(1.0));
  return scene;
}

} // namespace meninas::test
