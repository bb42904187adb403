#include "raytrace/lamp_weights.h"

#include "raytrace/quad_lanes.h"
#include "scenes/area_light.h"

#include <cmath>

namespace meninas {

double density_of_points(int points, double distance, double cosine, double area) {
  return points * distance * distance / std::max(cosine * area, 1e-300);
}

int points_per_lamp(const RenderContext& context) {
  return std::clamp(context.settings.glossy_samples / 4, 1, 16);
}

/// p / (p + q) of a ray that meets so much of a lamp, so far from the lobe.
static float share_of(const RenderContext& context, const SpecularRay& ray, double distance,
                      double cosine, double area) {
  const double q = density_of_points(points_per_lamp(context), distance, cosine, area);
  return static_cast<float>(double{ray.density} / (double{ray.density} + q));
}

float share_of_rays(const RenderContext& context, const LaneState& state, const FaceRecord& face,
                    const HitPacket& hits, std::uint32_t k) {
  const LightScene& light = context.light;
  if (!state.specular || state.specular[k].density == 0.0F ||
      state.specular[k].world == none<WorldId> || light.direct_sides[face.side] == 0)
    return 1.0F;
  const SpecularRay& ray = state.specular[k];
  const MeshSide& side = light.mesh.sides[face.side];
  const double area =
      side.textured
          ? light.mesh
                .area[field_point(light.landing.elements, face.side, uv_of(light, face, hits, k)).element]
          : light.surfaces.patches[index(side.patch)].area;
  const double distance =
      double{ray.since_lobe} + double{hits.distance[k]} / light.rays.frame().scale;
  return share_of(context, ray, distance, std::abs(glm::dot(face.normal, ray.direction)), area);
}

void show_area_lights(const RenderContext& context, const LaneState& state, std::uint32_t count,
                      const HitPacket& hits, TileWorkspace& work) {
  // Their light is emission, as lamps' is: reflected light has no part in it (light_parts).
  const ReflectedPart part = context.visible.part;
  if (part != ReflectedPart::all && part != ReflectedPart::none)
    return;
  const RayFrame& frame = context.light.rays.frame();
  for (const AreaLight& light : context.light.scene.area_lights) {
    const double area = area_of(light);
    for (std::uint32_t k = 0; k < count; ++k) {
      const SpecularRay& ray = state.specular[k];
      const Point3 from = Point3(ray.origin) / frame.scale + frame.centre;
      const auto t = lit_crossing(light, from, ray.direction);
      // Distances of hits are in lengths of the direction, in the frame of the rays.
      if (!t || (hits.triangle[k] != index(none<TriangleId>) &&
                 double{hits.distance[k]} < *t * frame.scale))
        continue;
      const double length = glm::length(ray.direction);
      const bool sampled = ray.density > 0.0F && ray.world != none<WorldId>;
      const float share =
          sampled ? share_of(context, ray, double{ray.since_lobe} + *t * length,
                             std::abs(glm::dot(light.axis, ray.direction)) / length, area)
                  : 1.0F;
      work.sums[ray.way][ray.pixel] += share * ray.throughput * glm::vec3(light.radiance);
    }
  }
}

} // namespace meninas
