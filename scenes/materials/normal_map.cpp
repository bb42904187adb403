#include "scenes/materials/normal_map.h"

#include "scenes/materials/lobes.h"
#include "scenes/shading_normal.h"

#include <array>
#include <cmath>
#include <optional>

namespace meninas {

namespace {

/// T with its sign w; zero where nothing is known.
using Tangent = glm::dvec4;

/// Of the triangle's own texture coordinates; zero where they do not change.
Tangent own_tangent(const Scene& scene, TriangleId triangle, const TextureUse& use) {
  const auto p = corners(scene, triangle);
  const auto uv = [&](std::size_t k) {
    const VertexId v = scene.triangles[index(triangle)].vertices[k];
    return transformed_texcoord(
        use, Vec2(attributes_of(scene, v).texcoord[static_cast<std::size_t>(use.texcoord_set)]));
  };
  const Vec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const double det = d1.x * d2.y - d1.y * d2.x;
  const double sign = det < 0.0 ? -1.0 : 1.0;
  const Vec3 along = sign * (d2.y * (p[1] - p[0]) - d1.y * (p[2] - p[0]));
  const double length = glm::length(along);
  if (det == 0.0 || !(length > 0.0) || !std::isfinite(length))
    return Tangent(0.0);
  return Tangent(along / length, -sign);
}

/// Made perpendicular to the normal; zero along it.
Tangent across(const Tangent& tangent, const Direction& normal) {
  constexpr double along = 0.01; // a sine; nearer to it rounding decides
  const Vec3 flat = Vec3(tangent) - glm::dot(Vec3(tangent), normal) * normal;
  const double length = glm::length(flat);
  return length > along ? Tangent(flat / length, tangent.w) : Tangent(0.0);
}

/// Whose coordinates T and B follow.
TextureUse frame_of(const Material& material) {
  if (material.normal_texture)
    return *material.normal_texture;
  TextureUse use;
  if (material.anisotropy_texture)
    use.texcoord_set = material.anisotropy_texture->texcoord_set;
  return use;
}

/// The axes of the map at a point.
struct MapFrame {
  Vec3 along{0.0}, up{0.0}, out{0.0};
};

MapFrame map_frame(const Scene& scene, TriangleId triangle, Vec2 barycentric) {
  const Material& material = material_of(scene, triangle);
  const TextureUse use = frame_of(material);
  const bool is_anisotropic = material.anisotropy > 0.0;
  const std::array<double, 3> weights{1.0 - barycentric.x - barycentric.y, barycentric.x,
                                      barycentric.y};
  const auto normals = corner_normals(scene, triangle);
  std::optional<Tangent> own;
  MapFrame frame;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = index(scene.triangles[index(triangle)].vertices[k]);
    Tangent tangent(0.0);
    if (vertex < scene.tangents.size())
      tangent = across(Tangent(scene.tangents[vertex]), normals[k]);
    if (tangent == Tangent(0.0)) {
      if (!own)
        own = own_tangent(scene, triangle, use);
      tangent = across(*own, normals[k]);
    }
    if (tangent == Tangent(0.0) && is_anisotropic)
      tangent = Tangent(level_tangent(normals[k]), 1.0);
    frame.along += weights[k] * Vec3(tangent);
    frame.up += weights[k] * tangent.w * glm::cross(normals[k], Vec3(tangent));
    frame.out += weights[k] * normals[k];
  }
  return frame;
}

} // namespace

Direction mapped_normal(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
                        Vec2 barycentric, const Footprint& footprint) {
  const Material& material = material_of(scene, triangle);
  const auto& use = material.normal_texture;
  if (!use || index(use->texture) >= textures.numbers.size() ||
      textures.numbers[index(use->texture)].texels.empty())
    return shading_normal(scene, triangle, barycentric);
  const glm::dvec4 texel =
      texel_at(scene, textures.numbers, *use, triangle, barycentric, footprint);
  const Vec2 slope = material.normal_scale * (2.0 * Vec2(texel) - 1.0);
  const MapFrame frame = map_frame(scene, triangle, barycentric);
  const Vec3 turned =
      slope.x * frame.along + slope.y * frame.up + (2.0 * texel.b - 1.0) * frame.out;
  const double length = glm::length(turned);
  if (!(length > 1e-6))
    return glm::normalize(frame.out);
  constexpr double lowest = 0.02; // a cosine
  const Direction face = glm::normalize(area_vector(corners(scene, triangle)));
  const Direction n = turned / length;
  const double height = glm::dot(n, face);
  return height >= lowest ? n : glm::normalize(n + (lowest - height) * face);
}

Direction level_tangent(const Direction& normal) {
  const Tangent level = across(Tangent(normal.z, 0.0, -normal.x, 1.0), normal);
  return Vec3(level != Tangent(0.0) ? level : across(Tangent(1.0, 0.0, 0.0, 1.0), normal));
}

Vec2 facet_axis(const Scene& scene, TriangleId triangle, Vec2 barycentric, Vec2 direction,
                const Direction& normal) {
  const MapFrame frame = map_frame(scene, triangle, barycentric);
  const Direction axis = to_local(normal, direction.x * frame.along + direction.y * frame.up);
  const double length = std::hypot(axis.x, axis.y);
  return length > 1e-9 ? Vec2(axis.x, axis.y) / length : Vec2(1.0, 0.0);
}

} // namespace meninas
