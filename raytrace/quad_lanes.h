// Sixteen rays that have landed on one quad side, looked up in the field together.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "raytrace/field_shading.h"
#include "scenes/rays/lanes.h"
#include "scenes/rays/ray_scene.h"

#include <array>
#include <bit>

namespace meninas {

/// (u, v) of lane k, which has hit the face.
inline glm::vec2 uv_of(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                       std::uint32_t k) {
  return hit_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
}

using LaneFloats = std::array<float, packet_size>;
using LaneIndices = std::array<std::uint32_t, packet_size>;

/// Where on a quad side the lanes have landed: element or cell of the field, and place in it.
struct alignas(64) LanePoints {
  LaneIndices element;
  LaneFloats s, t;
};

/// land(), sixteen at a time, of the lanes that have hit the face. Where the others are said to be
/// is without meaning: they may have hit nothing, and then have no triangle to be looked up.
LanePoints land_on_quad(const LightScene& light, const ElementTable& lookup, const FaceRecord& face,
                        const HitPacket& hits, std::uint32_t lanes);

/// Calls visit(k) for the lanes whose bits are set.
template <typename Visit>
void for_each_lane(std::uint32_t lanes, Visit visit) {
  for (; lanes != 0; lanes &= lanes - 1)
    visit(static_cast<std::uint32_t>(std::countr_zero(lanes)));
}

inline constexpr std::uint32_t all_lanes = (1U << packet_size) - 1U;

/// Bit k is set where values[k] is `value`.
std::uint32_t lanes_equal(const std::uint32_t* values, std::uint32_t value);

/// The face of ElementLookup that each lane has met; all lanes that have met nothing have the same number.
LaneIndices faces_of(const HitPacket& hits);

/// The sum of the radiances at the points of some lanes, W/m^2/sr, with one look-up for each element: the field is
/// bilinear, so L = a n + b sum s + c sum t + d sum s t.
glm::vec3 quad_radiance(const VisibleLight& visible, std::uint32_t side,
                        const LanePoints& at, std::uint32_t lanes);

} // namespace meninas
