#include "tests/radiosity/meshed.h"

#include "radiosity/mesh/make_mesh.h"

namespace meninas::test {

Meshed meshed(Scene scene, const MeshSettings& settings) {
  Meshed result{std::move(scene), {}, {}};
  result.surfaces = find_surfaces(result.scene);
  result.mesh = make_element_mesh(result.scene, result.surfaces, settings);
  return result;
}

Scene square() {
  Scene scene;
  add_polygon(scene, "square", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, diffuse(0.5));
  return scene;
}

Scene all_shapes() {
  Scene scene;
  add_polygon(scene, "parallelogram", {{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0.5, 1, 0}},
              diffuse(0.5));
  add_polygon(scene, "trapezoid", {{0, 0, 1}, {2, 0, 1}, {1.4, 1, 1}, {0.5, 1, 1}}, diffuse(0.5));
  add_polygon(scene, "quad", {{0, 0, 2}, {2, 0.3, 2}, {1.7, 1.5, 2}, {0.1, 1, 2}}, diffuse(0.5));
  add_polygon(scene, "triangle", {{0, 0, 3}, {2, 0, 3}, {0.3, 1.3, 3}}, diffuse(0.5));
  add_polygon(scene, "back", {{0, 0, 4}, {0, 1, 4}, {1, 1, 4.5}}, double_sided(diffuse(0.5)));
  add_polygon(scene, "sliver", {{0, 0, 5}, {2, 0, 5}, {2, 1e-4, 5}}, diffuse(0.5));
  add_polygon(scene, "ribbon", {{0, 0, 6}, {2, 0, 6}, {2, 1e-4, 6}, {0, 1e-4, 6}}, diffuse(0.5));
  return scene;
}

Scene patched_wall() {
  Scene scene = square();
  const auto extend = [&scene](const std::vector<Point3>& corners, const std::string& name) {
    add_polygon(scene, name, corners, diffuse(0.5));
    for (auto& triangle : scene.triangles)
      triangle.material = MaterialId{0};
  };
  extend({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}, "right");
  extend({{0, 1, 0}, {1, 1, 0}, {0, 2, 0}}, "above");
  extend({{1, 1, 0}, {2, 1, 0}, {2, 2.7, 0}}, "beside");
  return scene;
}

} // namespace meninas::test
