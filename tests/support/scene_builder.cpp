#include "tests/support/scene_builder.h"

#include <numbers>

namespace meninas::test {

Material diffuse(Rgb reflectance, Rgb emitted_radiosity) {
  Material material;
  material.base_color = reflectance;
  material.emission = emitted_radiosity / std::numbers::pi;
  return material;
}

Material diffuse(double reflectance, double emitted_radiosity) {
  return diffuse(Rgb(reflectance), Rgb(emitted_radiosity));
}

Material mirror(double reflectance) {
  Material material;
  material.base_color = Rgb(reflectance);
  material.metallic = 1.0;
  material.roughness = 0.0;
  return material;
}

Material double_sided(Material material) {
  material.double_sided = true;
  return material;
}

NodeId add_polygon(Scene& scene, const std::string& name, const std::vector<Point3>& corners,
                   const Material& material) {
  const auto node = static_cast<NodeId>(scene.nodes.size());
  const auto material_id = static_cast<MaterialId>(scene.materials.size());
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.nodes.push_back({name});
  scene.materials.push_back(material);
  for (const auto& corner : corners) {
    scene.vertices.push_back({.position = corner});
    const auto magnitude =
        glm::max(glm::abs(corner.x), glm::max(glm::abs(corner.y), glm::abs(corner.z)));
    scene.position_error = std::max(scene.position_error, 1e-15 * magnitude);
  }
  for (std::uint32_t k = 2; k < corners.size(); ++k)
    scene.triangles.push_back(
        {{VertexId{first}, VertexId{first + k - 1}, VertexId{first + k}}, material_id, node});
  return node;
}

static std::array<std::vector<Point3>, 6> inward_faces(Point3 a, Point3 b) {
  return {{
      {{a.x, a.y, b.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}},
      {{b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}},
      {{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}},
      {{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}},
      {{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}},
      {{b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}},
  }};
}

static constexpr std::array<const char*, 6> face_names{"x0", "x1", "y0", "y1", "z0", "z1"};

void add_room(Scene& scene, Point3 low, Point3 high, const std::array<Material, 6>& walls) {
  const auto faces = inward_faces(low, high);
  for (std::size_t k = 0; k < 6; ++k)
    add_polygon(scene, face_names[k], faces[k], walls[k]);
}

void add_box(Scene& scene, const std::string& name, Point3 low, Point3 high,
             const Material& material) {
  const auto faces = inward_faces(low, high);
  for (std::size_t k = 0; k < 6; ++k)
    add_polygon(scene, name + "." + face_names[k], {faces[k].rbegin(), faces[k].rend()}, material);
}

Camera look_at(Point3 eye, Point3 target, double vertical_fov) {
  Camera camera;
  camera.position = eye;
  camera.forward = glm::normalize(target - eye);
  camera.right = glm::normalize(glm::cross(camera.forward, Vec3(0.0, 1.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.vertical_fov = vertical_fov;
  return camera;
}

Scene transformed(const Scene& scene, const glm::dmat3& rotation, double scale, Vec3 offset) {
  Scene moved = scene;
  for (auto& vertex : moved.vertices)
    vertex.position = scale * (rotation * vertex.position) + offset;
  for (auto& camera : moved.cameras) {
    camera.position = scale * (rotation * camera.position) + offset;
    camera.right = rotation * camera.right;
    camera.up = rotation * camera.up;
    camera.forward = rotation * camera.forward;
    camera.half_height *= scale;
  }
  moved.position_error = scale * scene.position_error + 1e-15 * glm::length(offset);
  return moved;
}

} // namespace meninas::test
