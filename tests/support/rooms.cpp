#include "tests/support/rooms.h"

#include <algorithm>
#include <numbers>

namespace meninas::test {

Scene furnace(double reflectance, const std::array<bool, 6>& mirrors, Point3 size) {
  Scene scene;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k)
    walls[k] = mirrors[k] ? mirror(1.0) : diffuse(reflectance, 1.0);
  add_room(scene, Point3(0.0), size, walls);
  return scene;
}

namespace {

void add_furniture(Scene& scene) {
  add_polygon(scene, "lamp", {{0.7, 2.3, 1.2}, {1.3, 2.3, 1.2}, {1.3, 2.3, 1.8}, {0.7, 2.3, 1.8}},
              diffuse(0.0, 20.0));
  add_box(scene, "box", {0.6, 0.0, 0.8}, {1.2, 0.7, 1.5}, diffuse(Rgb(0.7, 0.6, 0.3)));
  scene.cameras.push_back(look_at({1.7, 1.3, 2.7}, {0.0, 1.0, 1.0}, 1.0));
}

std::array<Material, 6> coloured_walls() {
  return {mirror(1.0),  diffuse(Rgb(0.6, 0.2, 0.1)), diffuse(0.5),
          diffuse(0.7), diffuse(Rgb(0.2, 0.3, 0.6)), diffuse(0.6)};
}

} // namespace

Scene half_room() {
  Scene scene;
  add_room(scene, Point3(0.0), {2.0, 2.4, 3.0}, coloured_walls());
  add_furniture(scene);
  return scene;
}

Scene half_room_with_small_mirror() {
  Scene scene = half_room();
  scene.triangles.erase(scene.triangles.begin(), scene.triangles.begin() + 2);
  const auto piece = [](double y0, double z0, double y1, double z1) -> std::vector<Point3> {
    return {{0, y0, z1}, {0, y0, z0}, {0, y1, z0}, {0, y1, z1}};
  };
  const Material wall = diffuse(Rgb(0.5, 0.6, 0.4));
  add_polygon(scene, "mirror", piece(0.6, 0.5, 1.8, 1.7), mirror(1.0));
  add_polygon(scene, "below", piece(0.0, 0.0, 0.6, 3.0), wall);
  add_polygon(scene, "above", piece(1.8, 0.0, 2.4, 3.0), wall);
  add_polygon(scene, "left", piece(0.6, 0.0, 1.8, 0.5), wall);
  add_polygon(scene, "right", piece(0.6, 1.7, 1.8, 3.0), wall);
  return scene;
}

Scene doubled(const Scene& half) {
  const auto mirrors = [&half](const Triangle& triangle) {
    return is_mirror(half.materials[index(triangle.material)]);
  };
  const auto first = std::find_if(half.triangles.begin(), half.triangles.end(), mirrors);
  const auto corner = [&](std::size_t k) { return position(half, first->vertices[k]); };
  const Direction normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  const double offset = glm::dot(normal, corner(0));

  Scene whole = half;
  std::erase_if(whole.triangles, mirrors);
  const auto nodes = static_cast<std::uint32_t>(whole.nodes.size()),
             vertices = static_cast<std::uint32_t>(whole.vertices.size());
  const auto materials = static_cast<std::uint32_t>(whole.materials.size());
  for (std::uint32_t k = 0; k < nodes; ++k)
    whole.nodes.push_back({whole.nodes[k].name + ".image"});
  for (std::uint32_t k = 0; k < materials; ++k)
    whole.materials.push_back(Material(whole.materials[k]));
  for (std::uint32_t k = 0; k < vertices; ++k) {
    const Point3 x = whole.vertices[k].position;
    whole.vertices.push_back({.position = x - 2.0 * (glm::dot(normal, x) - offset) * normal});
  }
  for (std::size_t k = 0, count = whole.lights.size(); k < count; ++k) {
    PunctualLight image = whole.lights[k];
    image.position -= 2.0 * (glm::dot(normal, image.position) - offset) * normal;
    image.direction = glm::reflect(image.direction, normal);
    whole.lights.push_back(image);
  }
  // A reflection turns the order of the corners round.
  for (std::size_t k = 0, count = whole.triangles.size(); k < count; ++k) {
    Triangle image = whole.triangles[k];
    std::swap(image.vertices[1], image.vertices[2]);
    for (auto& vertex : image.vertices)
      vertex = VertexId{index(vertex) + vertices};
    image.material = MaterialId{index(image.material) + materials};
    image.node = NodeId{index(image.node) + nodes};
    whole.triangles.push_back(image);
  }
  return whole;
}

Scene facing_mirrors(Rgb reflectance) {
  Scene scene;
  Material glass = mirror(1.0);
  glass.base_color = reflectance;
  const Material black = diffuse(0.0);
  add_room(scene, Point3(0.0), Point3(1.0), {black, black, black, black, glass, glass});
  add_polygon(scene, "lamp",
              {{0.4, 0.99, 0.4}, {0.6, 0.99, 0.4}, {0.6, 0.99, 0.6}, {0.4, 0.99, 0.6}},
              diffuse(0.0, std::numbers::pi));
  return scene;
}

} // namespace meninas::test
