// Triangle soups for the tests of surfaces and patches, and what must hold for the model of any of
// them.
#pragma once

#include "scenes/surfaces/surfaces.h"

#include <cmath>
#include <functional>

namespace meninas::test {

inline constexpr MaterialId first_material{0};
inline constexpr NodeId first_node{0};

/// A scene with so many materials and nodes, and no geometry yet.
inline Scene empty_soup(std::size_t materials = 1, std::size_t nodes = 1) {
  Scene scene;
  scene.materials.resize(materials);
  for (std::size_t n = 0; n < nodes; ++n) {
    scene.nodes.push_back({"node" + std::to_string(n)});
  }
  return scene;
}

inline VertexId add_vertex(Scene& scene, const Point3& position) {
  scene.vertices.push_back({.position = position});
  return static_cast<VertexId>(scene.vertices.size() - 1);
}

inline void add_triangle(Scene& scene, const std::array<Point3, 3>& corners,
                         MaterialId material = first_material, NodeId node = first_node) {
  const VertexId a = add_vertex(scene, corners[0]);
  const VertexId b = add_vertex(scene, corners[1]);
  const VertexId c = add_vertex(scene, corners[2]);
  scene.triangles.push_back({{a, b, c}, material, node});
}

enum class Diagonal { first_to_third, second_to_fourth };

/// Two triangles over four vertices of their own.
inline void add_quad(Scene& scene, const std::array<Point3, 4>& p,
                     MaterialId material = first_material, NodeId node = first_node,
                     Diagonal diagonal = Diagonal::first_to_third) {
  std::array<VertexId, 4> v{};
  for (std::size_t k = 0; k < 4; ++k) {
    v[k] = add_vertex(scene, p[k]);
  }
  if (diagonal == Diagonal::first_to_third) {
    scene.triangles.push_back({{v[0], v[1], v[2]}, material, node});
    scene.triangles.push_back({{v[0], v[2], v[3]}, material, node});
  } else {
    scene.triangles.push_back({{v[0], v[1], v[3]}, material, node});
    scene.triangles.push_back({{v[1], v[2], v[3]}, material, node});
  }
}

/// columns x rows quads over shared vertices, at p(i / columns, j / rows).
inline void add_grid(Scene& scene, int columns, int rows,
                     const std::function<Point3(double, double)>& p) {
  const auto first = static_cast<int>(scene.vertices.size());
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      add_vertex(scene, p(double(i) / columns, double(j) / rows));
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<VertexId>(first + j * (columns + 1) + i);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      scene.triangles.push_back(
          {{at(i, j), at(i + 1, j), at(i + 1, j + 1)}, first_material, first_node});
      scene.triangles.push_back(
          {{at(i, j), at(i + 1, j + 1), at(i, j + 1)}, first_material, first_node});
    }
  }
}

/// The scene as an exporter writes it: positions rounded to floats.
inline Scene rounded_to_float(Scene scene) {
  double largest = 0.0;
  for (Vertex& vertex : scene.vertices) {
    vertex.position = Point3(glm::vec3(vertex.position));
    largest = std::max(largest, glm::length(vertex.position));
  }
  // Half a unit in the last of 24 bits, per coordinate.
  scene.position_error = largest * std::ldexp(1.0, -24);
  return scene;
}

/// A rotation without any special direction.
inline glm::dmat3 oblique_rotation() {
  const Vec3 a = glm::normalize(Vec3(0.3, -0.8, 0.52));
  const Vec3 b = glm::normalize(glm::cross(a, Vec3(0.1, 0.7, -0.4)));
  return {a, b, glm::cross(a, b)};
}

/// Checks what holds for the model of any scene.
void expect_consistent(const Scene& scene, const SurfaceModel& model);

} // namespace meninas::test
