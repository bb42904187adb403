#include "raytrace/shading.h"

#include "raytrace/lamp_weights.h"
#include "raytrace/lane_surface.h"
#include "raytrace/quad_lanes.h"
#include "raytrace/scattering.h"
#include "raytrace/specular_rays.h"
#include "scenes/sky/radiance_map.h"

#include <numbers>

namespace meninas {

namespace {

/// Whether some of what meets nothing shows light.
bool shows_sky(const VisibleLight& visible) {
  return visible.sky != nullptr || visible.background != glm::vec3(0.0F);
}

/// The radiance of lane k where it has met nothing. Lobes have the light of suns by themselves.
glm::vec3 sky_seen(const VisibleLight& visible, const RayPacket& packet, const LaneState& state,
                   std::uint32_t k) {
  if (visible.sky == nullptr)
    return visible.background;
  const bool in_lobe = state.specular && state.specular[k].lobes > 0;
  return radiance_from(*visible.sky,
                       {packet.direction_x[k], packet.direction_y[k], packet.direction_z[k]},
                       in_lobe ? Suns::left_out : Suns::shown);
}

/// Queues the ray that goes on from where a lane has met an ideal mirror.
void reflect_lane(const LandedLane& lane, TileWorkspace& work) {
  if (lane.face.mirrors && lane.context.settings.mode == RenderMode::hybrid &&
      !meets_lobes(lane.context, lane.face, lane.hits, lane.k))
    reflect(lane, work);
}

/// The radiance of a face in a lane that shares its light with no other.
glm::vec3 radiance_by_itself(const LandedLane& lane, TileWorkspace& work) {
  if (meets_lobes(lane.context, lane.face, lane.hits, lane.k))
    return scattered_radiance(lane, work);
  return lane.face.side == FaceRecord::nothing ? glm::vec3(0.0F) : radiance_of_lane(lane, work);
}

/// Where light is computed at the hits: lane by lane.
void shade_by_lanes(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                    const HitPacket& hits, TileWorkspace& work) {
  const LightScene& light = context.light;
  glm::vec3 sum(0.0F); // of lanes of one pixel in a row
  for (std::uint32_t k = 0; k < packet.count; ++k) {
    glm::vec3 radiance(0.0F);
    if (hits.triangle[k] == index(none<TriangleId>)) {
      radiance = sky_seen(context.visible, packet, state, k);
    } else {
      const FaceRecord& face = face_of(light.landing, hits, k);
      const LandedLane lane{context, packet, state, face, hits, k};
      if (meets_lobes(context, face, hits, k) || face.side == FaceRecord::nothing) {
        radiance = radiance_by_itself(lane, work);
      } else {
        const SideShading shading = shading_at(lane);
        radiance = share_of_rays(context, state, face, hits, k) * shading.emitted;
        if (shading.albedo_over_pi != glm::vec3(0.0F))
          radiance +=
              shading.albedo_over_pi * irradiance_of_lane(context, state, face, hits, k, work);
        if (shading.passed_over_pi != glm::vec3(0.0F))
          radiance += shading.passed_over_pi * irradiance_behind(lane, work);
      }
      reflect_lane(lane, work);
    }
    sum += state.throughput(k) * radiance;
    if (k + 1 < packet.count && state.pixel[k + 1] == state.pixel[k] &&
        state.way(k + 1) == state.way(k))
      continue;
    work.sums[state.way(k)][state.pixel[k]] += sum;
    sum = glm::vec3(0.0F);
  }
}

/// Whether lanes on a face look the field up together.
bool lands_together(const RenderContext& context, const LaneState& state, const FaceRecord& face,
                    const HitPacket& hits, std::uint32_t lanes) {
  if (face.side == FaceRecord::nothing || face.mapped || std::has_single_bit(lanes) ||
      context.visible.lookup.sides[face.side].triangle)
    return false;
  const auto k = static_cast<std::uint32_t>(std::countr_zero(lanes));
  const SideShading& side = context.visible.shading[face.side];
  // The light of lamps on rays of lobes is weighed ray by ray.
  const bool weighed = state.specular && !context.bsdfs.empty() && side.emitted != glm::vec3(0.0F);
  return !side.is_by_point() && !weighed && !meets_lobes(context, face, hits, k);
}

/// The lanes that belong to the pixel of the first.
std::uint32_t lanes_of_first_pixel(const LaneState& state, std::uint32_t lanes) {
  const std::uint32_t pixel = state.pixel[std::countr_zero(lanes)];
  // Camera rays come in the order of their pixels.
  if (!state.specular && state.pixel[std::bit_width(lanes) - 1] == pixel)
    return lanes;
  return lanes & lanes_equal(state.pixel, pixel);
}

/// Adds what lanes show that have landed on one quad side, pixel by pixel.
void add_quad(const RenderContext& context, const LaneState& state, const FaceRecord& face,
              const HitPacket& hits, std::uint32_t lanes, TileWorkspace& work) {
  const LightScene& light = context.light;
  const LanePoints at = land_on_quad(light, context.visible.lookup, face, hits, lanes);
  while (lanes != 0) {
    const auto first = static_cast<std::uint32_t>(std::countr_zero(lanes));
    std::uint32_t alike = lanes_of_first_pixel(state, lanes);
    if (state.specular)
      for_each_lane(alike, [&](std::uint32_t k) {
        if (state.way(k) != state.way(first) || state.throughput(k) != state.throughput(first))
          alike &= ~(1U << k);
      });
    lanes &= ~alike;
    work.sums[state.way(first)][state.pixel[first]] +=
        state.throughput(first) * quad_radiance(context.visible, face.side, at, alike);
  }
}

/// Where the field is all: what lanes show that have met one face, or nothing.
void shade_face(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                const HitPacket& hits, std::uint32_t lanes, TileWorkspace& work) {
  const auto add = [&](std::uint32_t k, const glm::vec3& radiance) {
    work.sums[state.way(k)][state.pixel[k]] += state.throughput(k) * radiance;
  };
  const auto first = static_cast<std::uint32_t>(std::countr_zero(lanes));
  if (hits.triangle[first] == index(none<TriangleId>)) {
    if (shows_sky(context.visible))
      for_each_lane(lanes, [&](std::uint32_t k) {
        add(k, sky_seen(context.visible, packet, state, k));
      });
    return;
  }
  const FaceRecord& face = face_of(context.light.landing, hits, first);
  if (lands_together(context, state, face, hits, lanes))
    add_quad(context, state, face, hits, lanes, work);
  else if (face.side != FaceRecord::nothing || face.mirrors)
    for_each_lane(lanes, [&](std::uint32_t k) {
      add(k, radiance_by_itself({context, packet, state, face, hits, k}, work));
    });
  if (face.mirrors)
    for_each_lane(lanes, [&](std::uint32_t k) {
      reflect_lane({context, packet, state, face, hits, k}, work);
    });
}

} // namespace

void shade_packet(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                  const HitPacket& hits, TileWorkspace& work) {
  if (context.settings.diffuse.term != DiffuseTerm::interpolated)
    return shade_by_lanes(context, packet, state, hits, work);
  const LaneIndices faces = faces_of(hits);
  for (std::uint32_t rest = (1U << packet.count) - 1U, lanes = 0; rest != 0; rest &= ~lanes) {
    lanes =
        rest & lanes_equal(faces.data(), faces[static_cast<std::size_t>(std::countr_zero(rest))]);
    shade_face(context, packet, state, hits, lanes, work);
  }
}

void shade_alike(const RenderContext& context, const RayPacket& packet, const LaneState& state,
                 const HitPacket& hits, TileWorkspace& work) {
  if (context.settings.diffuse.term != DiffuseTerm::interpolated)
    return shade_by_lanes(context, packet, state, hits, work);
  shade_face(context, packet, state, hits, all_lanes, work);
}

} // namespace meninas
