#include "raytrace/shading.h"

#include "radiosity/surface_colour.h"
#include "raytrace/footprint.h"
#include "raytrace/quad_lanes.h"
#include "raytrace/scattering.h"
#include "raytrace/specular_paths.h"

#include <limits>
#include <numbers>

namespace meninas {

Receiver receiver_at(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                     std::uint32_t k) {
  const auto [a, b, c] = corners(light.scene, TriangleId{hits.triangle[k]});
  return {a + double{hits.b1[k]} * (b - a) + double{hits.b2[k]} * (c - a), face.normal,
          static_cast<PlaneId>(face.plane_class),
          face.side == FaceRecord::nothing ? Vec3(0.0) : light.mesh.sides[face.side].tangent};
}

SideShading shading_at(const RenderContext& context, const RayPacket& packet,
                       const LaneState& state, const FaceRecord& face, const HitPacket& hits,
                       std::uint32_t k) {
  const SideShading& side = context.visible.shading[face.side];
  if (!side.textured)
    return side;
  const LightScene& light = context.light;
  const SurfaceColour colour =
      surface_colour(light.scene, light.textures, TriangleId{hits.triangle[k]},
                     {hits.b1[k], hits.b2[k]}, footprint_of(context, packet, state, face, hits, k));
  const ReflectedPart part = context.visible.part;
  const bool emits = part == ReflectedPart::all || part == ReflectedPart::none;
  SideShading shading;
  if (emits)
    shading.emitted = colour.emission / std::numbers::pi;
  if (part != ReflectedPart::none)
    shading.albedo_over_pi = colour.reflectance / std::numbers::pi;
  return shading;
}

glm::vec3 irradiance_of_lane(const RenderContext& context, const LaneState& state,
                             const FaceRecord& face, const HitPacket& hits, std::uint32_t k,
                             TileWorkspace& work) {
  const LightScene& light = context.light;
  const FieldPoint at = field_point(light.landing, face.side, uv_of(light, face, hits, k));
  const glm::vec3 field =
      field_irradiance(light.mesh, context.visible.irradiance, at.element, at.place);
  const DiffuseSettings& diffuse = context.settings.diffuse;
  const std::uint32_t key = state.key(k, context.settings.seed);
  return irradiance_at_point(light, diffuse, context.gathering, context.visible.part, field,
                             receiver_at(light, face, hits, k),
                             diffuse.draw == 0 ? key : hash(key, diffuse.draw), work.point);
}

glm::vec3 radiance_of_lane(const RenderContext& context, const RayPacket& packet,
                           const LaneState& state, const FaceRecord& face, const HitPacket& hits,
                           std::uint32_t k, TileWorkspace& work) {
  SideShading shading = shading_at(context, packet, state, face, hits, k);
  shading.emitted *= share_of_rays(context, state, face, hits, k);
  if (context.settings.diffuse.term != DiffuseTerm::interpolated)
    return shading.emitted +
           shading.albedo_over_pi * irradiance_of_lane(context, state, face, hits, k, work);
  return field_radiance(context.light.mesh, context.visible.irradiance, shading,
                        context.light.landing, face.side, uv_of(context.light, face, hits, k));
}

namespace {

/// The sum of H over sixteen samples of one pixel on one side: of the first four, which are spread over the pixel, where they agree.
glm::vec3 irradiance_of_packet(const RenderContext& context, const LaneState& state,
                               const FaceRecord& face, const HitPacket& hits, TileWorkspace& work) {
  constexpr std::uint32_t few = 4;
  constexpr float alike = 0.005F; // relative: too little to be seen
  glm::vec3 sum(0.0F), low(std::numeric_limits<float>::infinity()), high(0.0F);
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    const glm::vec3 h = irradiance_of_lane(context, state, face, hits, k, work);
    sum += h;
    low = glm::min(low, h);
    high = glm::max(high, h);
    if (k + 1 == few && glm::all(glm::lessThanEqual(high - low, alike * high)))
      return static_cast<float>(packet_size) / static_cast<float>(few) * sum;
  }
  return sum;
}

/// Adds what each ray has landed on to its pixel, and queues the rays that a mirror sends on.
void shade_one_by_one(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                      const HitPacket& hits, TileWorkspace& work) {
  const LightScene& light = context.light;
  const bool mirrors = context.settings.mode == RenderMode::hybrid;
  glm::vec3 sum(0.0F); // of lanes of one pixel in a row
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    if (hits.triangle[k] != index(none<TriangleId>)) {
      const FaceRecord& face = face_of(light.landing, hits, k);
      const bool has_lobe = meets_lobes(context, face, hits, k);
      glm::vec3 radiance(0.0F);
      if (has_lobe)
        radiance = scattered_radiance(context, packet, state, face, hits, k, work);
      else if (face.side != FaceRecord::nothing)
        radiance = radiance_of_lane(context, packet, state, face, hits, k, work);
      sum += state.specular ? state.specular[k].throughput * radiance : radiance;
      if (face.mirrors && mirrors && !has_lobe)
        reflect(context, face, packet, state, k, hits.distance[k], work);
    } else {
      sum += state.specular ? state.specular[k].throughput * context.visible.background
                            : context.visible.background;
    }
    if (k + 1 < packet.count && state.pixel[k + 1] == state.pixel[k] &&
        state.way(k + 1) == state.way(k))
      continue;
    work.sums[state.way(k)][state.pixel[k]] += sum;
    sum = glm::vec3(0.0F);
  }
}

/// The common case of sixteen samples of one pixel that land on one quad side. Returns false where they do not.
bool shade_as_one(const RenderContext& context, const LaneState& state, const HitPacket& hits,
                  TileWorkspace& work) {
  std::uint32_t differ = 0;
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= hits.triangle[k] ^ hits.triangle[0];
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= static_cast<std::uint32_t>(hits.front[k] ^ hits.front[0]);
  for (std::uint32_t k = 0; k < packet_size; ++k)
    differ |= state.pixel[k] ^ state.pixel[0];
  if (differ != 0)
    return false;
  if (hits.triangle[0] == index(none<TriangleId>))
    return context.visible.background == glm::vec3(0.0F);
  const LightScene& light = context.light;
  const FaceRecord& face = face_of(light.landing, hits, 0);
  if (face.mirrors || meets_lobes(context, face, hits, 0) || face.side == FaceRecord::nothing ||
      light.landing.sides[face.side].triangle || context.visible.shading[face.side].textured)
    return false;
  glm::vec3 throughput(1.0F);
  if (state.specular) {
    throughput = state.specular[0].throughput;
    const bool glows = context.visible.shading[face.side].emitted != glm::vec3(0.0F);
    if (glows && state.specular[0].density != 0.0F)
      return false;
    for (std::uint32_t k = 1; k < packet_size; ++k)
      if (state.specular[k].throughput != throughput ||
          (glows && state.specular[k].density != 0.0F) || state.way(k) != state.way(0))
        return false;
  }

  if (context.settings.diffuse.term != DiffuseTerm::interpolated) {
    const SideShading& shading = context.visible.shading[face.side];
    const glm::vec3 h = irradiance_of_packet(context, state, face, hits, work);
    work.sums[state.way(0)][state.pixel[0]] +=
        throughput *
        (static_cast<float>(packet_size) * shading.emitted + shading.albedo_over_pi * h);
    return true;
  }
  const LanePoints at = land_on_quad(light, face, light.landing.sides[face.side], hits);
  work.sums[state.way(0)][state.pixel[0]] +=
      throughput * quad_radiance(light.mesh, context.visible, face.side, at);
  return true;
}

} // namespace

void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                  const HitPacket& hits, TileWorkspace& work) {
  if (packet.count == packet_size && shade_as_one(context, state, hits, work))
    return;
  shade_one_by_one(context, packet, state, hits, work);
}

} // namespace meninas
