#include "scenes/materials/normal_map.h"

#include "scenes/shading_normal.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// T and B; zero where the texture coordinates do not change.
struct TextureFrame {
  Vec3 along_u{0.0}, along_v{0.0};
};

TextureFrame texture_frame(const Scene& scene, TriangleId triangle, const TextureUse& use,
                           const Direction& normal) {
  const auto p = corners(scene, triangle);
  const auto uv = [&](std::size_t k) {
    const VertexId v = scene.triangles[index(triangle)].vertices[k];
    return transformed_texcoord(
        use, Vec2(scene.vertices[index(v)].texcoord[static_cast<std::size_t>(use.texcoord_set)]));
  };
  const Vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const double det = d1.x * d2.y - d1.y * d2.x;
  const double sign = det < 0.0 ? -1.0 : 1.0;
  Vec3 along = sign * (d2.y * (p[1] - p[0]) - d1.y * (p[2] - p[0]));
  along -= glm::dot(along, normal) * normal;
  const double length = glm::length(along);
  if (det == 0.0 || !(length > 0.0) || !std::isfinite(length))
    return {};
  const Direction t = along / length;
  return {t, sign * glm::cross(normal, t)};
}

} // namespace

Direction mapped_normal(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
                        Vec2 barycentric, const Footprint& footprint) {
  const Direction normal = shading_normal(scene, triangle, barycentric);
  const Material& material = material_of(scene, triangle);
  const auto& use = material.normal_texture;
  if (!use || index(use->texture) >= textures.numbers.size() ||
      textures.numbers[index(use->texture)].texels.empty())
    return normal;
  const glm::dvec4 texel =
      texel_at(scene, textures.numbers, *use, triangle, barycentric, footprint);
  const Vec2 slope = material.normal_scale * (2.0 * Vec2(texel) - 1.0);
  const TextureFrame frame = texture_frame(scene, triangle, *use, normal);
  const Vec3 turned =
      slope.x * frame.along_u - slope.y * frame.along_v + (2.0 * texel.b - 1.0) * normal;
  const double length = glm::length(turned);
  if (!(length > 1e-6))
    return normal;
  constexpr double lowest = 0.02; // a cosine
  const Direction face = glm::normalize(area_vector(corners(scene, triangle)));
  const Direction n = turned / length;
  const double height = glm::dot(n, face);
  return height >= lowest ? n : glm::normalize(n + (lowest - height) * face);
}

} // namespace meninas
