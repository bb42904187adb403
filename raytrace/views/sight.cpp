#include "raytrace/views/sight.h"

#include "radiosity/scene/surface_colour.h"
#include "scenes/materials/normal_map.h"
#include "scenes/shading_normal.h"

#include <algorithm>
#include <utility>

namespace meninas {

/// Where glass is taken for not being there.
static bool passes_most(const LightScene& light, const Hit& hit) {
  const Material& material = material_of(light.scene, hit.triangle);
  const bool varies = material.transmission_texture ||
                      (is_blended(material) && (material.base_color_texture ||
                                                has_vertex_colors(light.scene, hit.triangle)));
  const double transmission =
      varies
          ? material_at(light.scene, light.textures, hit.triangle, hit.barycentric).transmission
          : material.transmission;
  return transmission >= 0.5;
}

SightStep sight_step(const LightScene& light, const FaceRecord& face, const Hit& hit) {
  if (face.glass)
    return passes_most(light, hit) ? SightStep::through : SightStep::end;
  return face.mirrors ? SightStep::mirror : SightStep::end;
}

Direction seen_normal(const LightScene& light, const FaceRecord& face, const Hit& hit,
                      const Vec3& along) {
  if (!face.curved)
    return face.normal;
  const Direction n = mapped_normal(light.scene, light.textures, hit.triangle, hit.barycentric);
  return visible_normal(hit.front ? n : -n, face.normal, -glm::normalize(along));
}

Sight look(const LightScene& light, const Camera& camera, double picture_aspect, Vec2 at,
           int max_mirrors) {
  const CameraRay start = camera_ray(camera, picture_aspect, at.x, at.y);
  Ray ray{start.origin, start.direction};
  Sight sight;
  double step = 0.0;
  for (Backs backs = Backs::transparent, next = Backs::absorb;;
       backs = std::exchange(next, Backs::absorb)) {
    const auto hit = closest_hit(light.rays, ray, backs);
    if (!hit)
      return {.mirrors = sight.mirrors};
    const FaceRecord& face =
        light.landing.faces[2 * std::size_t{index(hit->triangle)} + (hit->front ? 0 : 1)];
    sight.triangle = hit->triangle;
    sight.barycentric = hit->barycentric;
    sight.position = ray.origin + hit->distance * ray.direction;
    sight.distance += hit->distance * glm::length(ray.direction);
    sight.normal = seen_normal(light, face, *hit, ray.direction);
    if (face.side != FaceRecord::nothing) {
      sight.side = face.side;
      const glm::vec2 b(hit->barycentric);
      sight.uv = hit_uv(face, light.surfaces, index(hit->triangle), b.x, b.y);
      sight.place = field_point(light.landing.elements, face.side, sight.uv);
    }
    const SightStep to = sight_step(light, face, *hit);
    if (to == SightStep::end || (to == SightStep::mirror && sight.mirrors >= max_mirrors))
      return sight;
    ray.origin = sight.position;
    ray.leaving = static_cast<PlaneId>(face.plane_class);
    if (to == SightStep::through) {
      next = backs;
      // Where panes meet in an edge the one that was left before is met again,
      // unless the eye goes on: in steps that double.
      step = hit->distance > step ? 0.0 : std::max(2.0 * step, 1e-15 / light.rays.frame().scale);
      ray.origin += step * ray.direction;
    } else {
      ++sight.mirrors;
      ray.direction -= 2.0 * glm::dot(sight.normal, ray.direction) * sight.normal;
    }
    sight.side = FaceRecord::nothing;
  }
}

std::optional<PatchPlace> place_behind(const LightScene& light, SideId side, TriangleId triangle,
                                       Vec2 barycentric) {
  const SideId behind = side_behind(light.mesh, side);
  if (behind == none<SideId>)
    return std::nullopt;
  const std::size_t front = 2 * std::size_t{index(triangle)};
  const std::size_t face = light.landing.faces[front].side == index(behind) ? front : front + 1;
  const glm::vec2 b(barycentric);
  return PatchPlace{static_cast<std::uint32_t>(index(behind)),
                    hit_uv(light.landing.faces[face], light.surfaces, index(triangle), b.x, b.y)};
}

Rgb albedo_at(const LightScene& light, const Sight& sight) {
  if (sight.side == FaceRecord::nothing)
    return Rgb(0.0);
  const MeshSide& side = light.mesh.sides[sight.side];
  if (!side.textured)
    return side.reflectance;
  return surface_colour(light.scene, light.textures, sight.triangle, sight.barycentric).reflectance;
}

} // namespace meninas
