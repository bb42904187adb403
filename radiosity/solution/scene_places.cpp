#include "radiosity/solution/scene_places.h"

#include "scenes/materials/texture_lookup.h"

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

/// The weights of the three corners.
glm::vec3 weights_at(const ScenePlace& at) {
  return {1.0 - at.barycentric.x - at.barycentric.y, at.barycentric.x, at.barycentric.y};
}

const VertexAttributes& corner(const Scene& scene, const ScenePlace& at, int k) {
  return attributes_of(scene, scene.triangles[index(at.triangle)].vertices[std::size_t(k)]);
}

} // namespace

ScenePlace place_on(const Scene& scene, const Patch& patch, const Point3& x) {
  ScenePlace best{patch.triangles[0], Vec2(0.0)};
  double most = -std::numeric_limits<double>::infinity();
  for (const TriangleId triangle : patch.triangles) {
    if (triangle == none<TriangleId>)
      continue;
    const auto p = corners(scene, triangle);
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], normal = glm::cross(e1, e2);
    const Vec2 b = Vec2(glm::dot(glm::cross(x - p[0], e2), normal),
                        glm::dot(glm::cross(e1, x - p[0]), normal)) /
                   glm::dot(normal, normal);
    if (const double least = std::min({b.x, b.y, 1.0 - b.x - b.y}); least > most) {
      most = least;
      best = {triangle, b};
    }
  }
  return best;
}

glm::vec2 texture_place(const Scene& scene, const std::optional<TextureUse>& use,
                        const ScenePlace& at) {
  if (!use)
    return glm::vec2(0.0F);
  const glm::vec3 weights = weights_at(at);
  glm::vec2 place(0.0F);
  for (int k = 0; k < 3; ++k)
    place += weights[k] * corner(scene, at, k).texcoord[std::size_t(use->texcoord_set)];
  return glm::vec2(transformed_texcoord(*use, Vec2(place)));
}

glm::vec4 vertex_colour(const Scene& scene, const ScenePlace& at) {
  const glm::vec3 weights = weights_at(at);
  glm::vec4 colour(0.0F);
  for (int k = 0; k < 3; ++k)
    colour += weights[k] * corner(scene, at, k).color;
  return colour;
}

} // namespace meninas
