#include "raytrace/lane_surface.h"

#include "radiosity/scene/surface_colour.h"
#include "raytrace/footprint.h"
#include "raytrace/lamp_weights.h"
#include "raytrace/quad_lanes.h"
#include "scenes/rays/curved_origin.h"
#include "scenes/materials/coverage.h"
#include "scenes/materials/normal_map.h"
#include "scenes/shading_normal.h"

#include <numbers>

namespace meninas {

/// n(b), towards the side that was met.
static Direction curve_normal(const LightScene& light, const HitPacket& hits, std::uint32_t k,
                              const Footprint& footprint = {}) {
  const Direction n = mapped_normal(light.scene, light.textures, TriangleId{hits.triangle[k]},
                                    {hits.b1[k], hits.b2[k]}, footprint);
  return hits.front[k] != 0 ? n : -n;
}

Direction normal_towards(const LandedLane& lane, const Direction& out) {
  if (!lane.face.curved)
    return lane.face.normal;
  const Footprint footprint = lane.face.mapped ? footprint_of(lane) : Footprint{};
  return visible_normal(curve_normal(lane.context.light, lane.hits, lane.k, footprint),
                        lane.face.normal, out);
}

static Receiver curved_receiver(const LightScene& light, const FaceRecord& face,
                                const HitPacket& hits, std::uint32_t k) {
  const TriangleId triangle{hits.triangle[k]};
  const Vec2 at(hits.b1[k], hits.b2[k]);
  Receiver receiver;
  if (const Material& material = material_of(light.scene, triangle);
      (is_glass(material) && !is_blended(material)) || is_translucent(material)) {
    // Light passes a pane or a translucent surface at itself.
    const auto [a, b, c] = corners(light.scene, triangle);
    receiver.position = a + at.x * (b - a) + at.y * (c - a);
    receiver.plane_class = static_cast<PlaneId>(face.plane_class);
  } else {
    receiver.position = curved_origin(light.scene, light.surfaces, light.rays, triangle, at,
                                      hits.front[k] != 0);
  }
  receiver.normal = curve_normal(light, hits, k);
  if (face.side != FaceRecord::nothing) {
    receiver.tangent = light.mesh.sides[face.side].tangent;
    receiver.coat = light.mesh.sides[face.side].coat;
  }
  return receiver;
}

Receiver receiver_at(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                     std::uint32_t k) {
  if (face.curved)
    return curved_receiver(light, face, hits, k);
  const auto [a, b, c] = corners(light.scene, TriangleId{hits.triangle[k]});
  const Point3 at = a + double{hits.b1[k]} * (b - a) + double{hits.b2[k]} * (c - a);
  const auto plane = static_cast<PlaneId>(face.plane_class);
  if (face.side == FaceRecord::nothing)
    return {at, face.normal, plane};
  const MeshSide& side = light.mesh.sides[face.side];
  return {at, face.normal, plane, side.tangent, side.coat};
}

SideShading shading_at(const LandedLane& lane) {
  const auto& [context, packet, state, face, hits, k] = lane;
  const SideShading& side = context.visible.shading[face.side];
  if (!side.textured)
    return side;
  const LightScene& light = context.light;
  const TriangleId triangle{hits.triangle[k]};
  const Vec2 barycentric(hits.b1[k], hits.b2[k]);
  const ReflectedPart part = context.visible.part;
  const bool emits = part == ReflectedPart::all || part == ReflectedPart::none;
  SideShading shading;
  if (const Material& material = material_of(light.scene, triangle); material.unlit) {
    if (emits)
      shading.emitted = shown_radiance(
          material,
          material_at(light.scene, light.textures, triangle, barycentric, footprint_of(lane)));
    return shading;
  }
  const SurfaceColour colour =
      surface_colour(light.scene, light.textures, triangle, barycentric, footprint_of(lane));
  if (emits)
    shading.emitted = colour.emission / std::numbers::pi;
  if (emits && !light.emission_factors.empty())
    shading.emitted *= glm::vec3(light.emission_factors[face.side]);
  if (part != ReflectedPart::none)
    shading.albedo_over_pi = colour.reflectance / std::numbers::pi;
  if (part != ReflectedPart::none)
    shading.passed_over_pi = colour.transmittance / std::numbers::pi;
  return shading;
}

/// The change of direct light by the normal map, D(n') - D(n): the field is that of the unmapped
/// surface, and light from all around hardly changes.
static glm::vec3 change_by_map(const RenderContext& context, const LaneState& state,
                               const FaceRecord& face, const HitPacket& hits, std::uint32_t k,
                               TileWorkspace& work) {
  const LightScene& light = context.light;
  DiffuseSettings settings = context.settings.diffuse;
  settings.term = DiffuseTerm::direct;
  // The same rays twice: of what they miss nearly all is in both.
  settings.direct.shadow_rays = settings.direct.penumbra_rays = 4;
  const DiffuseSource source{light, settings, nullptr, context.visible.part};
  const std::uint32_t key = state.key(k, context.settings.seed);
  Receiver receiver = receiver_at(light, face, hits, k);
  const glm::vec3 mapped = irradiance_at_point(source, glm::vec3(0.0F), receiver, key, work.point);
  const Direction n =
      shading_normal(light.scene, TriangleId{hits.triangle[k]}, {hits.b1[k], hits.b2[k]});
  receiver.normal = hits.front[k] != 0 ? n : -n;
  return mapped - irradiance_at_point(source, glm::vec3(0.0F), receiver, key, work.point);
}

glm::vec3 irradiance_of_lane(const RenderContext& context, const LaneState& state,
                             const FaceRecord& face, const HitPacket& hits, std::uint32_t k,
                             TileWorkspace& work) {
  const LightScene& light = context.light;
  const glm::vec3 field =
      field_irradiance(context.visible, face.side, uv_of(light, face, hits, k));
  const bool in_lobe = state.specular && state.specular[k].lobes > 0;
  const DiffuseSettings& diffuse = in_lobe ? context.behind_lobes : context.settings.diffuse;
  if (diffuse.term == DiffuseTerm::interpolated && face.mapped &&
      context.settings.mode == RenderMode::hybrid)
    return glm::max(field + change_by_map(context, state, face, hits, k, work), glm::vec3(0.0F));
  const std::uint32_t key = state.key(k, context.settings.seed);
  return irradiance_at_point({light, diffuse, context.gathering, context.visible.part}, field,
                             receiver_at(light, face, hits, k),
                             diffuse.draw == 0 ? key : hash(key, diffuse.draw), work.point);
}

glm::vec3 irradiance_behind(const LandedLane& lane, TileWorkspace& work) {
  const auto& [context, packet, state, face, hits, k] = lane;
  HitPacket turned = hits;
  turned.front[k] = hits.front[k] != 0 ? 0 : 1;
  const FaceRecord& behind = face_of(context.light.landing, turned, k);
  return behind.side == FaceRecord::nothing
             ? glm::vec3(0.0F)
             : irradiance_of_lane(context, state, behind, turned, k, work);
}

/// The radiance of a translucent surface by light from behind.
static glm::vec3 passed_radiance(const LandedLane& lane, const SideShading& shading,
                                 TileWorkspace& work) {
  return shading.passed_over_pi == glm::vec3(0.0F)
             ? glm::vec3(0.0F)
             : shading.passed_over_pi * irradiance_behind(lane, work);
}

glm::vec3 radiance_of_lane(const LandedLane& lane, TileWorkspace& work) {
  const auto& [context, packet, state, face, hits, k] = lane;
  SideShading shading = shading_at(lane);
  shading.emitted *= share_of_rays(context, state, face, hits, k);
  if (context.settings.diffuse.term != DiffuseTerm::interpolated || face.mapped)
    return shading.emitted +
           shading.albedo_over_pi * irradiance_of_lane(context, state, face, hits, k, work) +
           passed_radiance(lane, shading, work);
  return shading.emitted +
         shading.albedo_over_pi *
             field_irradiance(context.visible, face.side, uv_of(context.light, face, hits, k)) +
         passed_radiance(lane, shading, work);
}

} // namespace meninas
