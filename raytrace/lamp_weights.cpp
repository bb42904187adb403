#include "raytrace/lamp_weights.h"

#include "raytrace/quad_lanes.h"

#include <cmath>

namespace meninas {

double density_of_points(int points, double distance, double cosine, double area) {
  return points * distance * distance / std::max(cosine * area, 1e-300);
}


int points_per_lamp(const RenderContext& context) {
  return std::clamp(context.settings.glossy_samples / 4, 1, 16);
}

float share_of_rays(const RenderContext& context, const LaneState& state, const FaceRecord& face,
                    const HitPacket& hits, std::uint32_t k) {
  const LightScene& light = context.light;
  if (!state.specular || state.specular[k].density == 0.0F ||
      state.specular[k].world == none<WorldId> || light.from_source[face.side] == 0)
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
  const double q = density_of_points(points_per_lamp(context), distance,
                                     std::abs(glm::dot(face.normal, ray.direction)), area);
  return static_cast<float>(double{ray.density} / (double{ray.density} + q));
}

} // namespace meninas
