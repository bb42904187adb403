#include "raytrace/quad_lanes.h"

#include "raytrace/wide_lanes.h"

#include <cstring>

namespace meninas {

/// All lanes in registers: short loops over arrays are taken apart lane by lane.
using AllFloats = float __attribute__((vector_size(4 * packet_size)));
using AllBits = std::int32_t __attribute__((vector_size(4 * packet_size)));
using FourFloats = float __attribute__((vector_size(16)));
using FourBits = std::int32_t __attribute__((vector_size(16)));

template <typename Registers, typename Lanes>
static inline void load(Registers& registers, const Lanes& lanes) {
  static_assert(sizeof(Registers) == sizeof(Lanes));
  std::memcpy(&registers, &lanes, sizeof registers);
}

/// The sum over all lanes, four at a time.
static inline float sum_of(const AllFloats& values) {
  std::array<FourFloats, 4> four;
  load(four, values);
  const FourFloats sums = (four[0] + four[1]) + (four[2] + four[3]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Bit k is set where lane k of the comparison holds.
static inline std::uint32_t lanes_where(const AllBits& holds) {
  AllBits bits;
  load(bits, lane_bits);
  bits &= holds;
  std::array<FourBits, 4> four;
  load(four, bits);
  const FourBits all = (four[0] | four[1]) | (four[2] | four[3]);
  return static_cast<std::uint32_t>((all[0] | all[1]) | (all[2] | all[3]));
}

MENINAS_WIDE_LANES
std::uint32_t lanes_equal(const std::uint32_t* values, std::uint32_t value) {
  std::uint32_t lanes = 0;
  for (std::size_t k = 0; k < packet_size; ++k)
    lanes |= values[k] == value ? lane_bits[k] : 0U;
  return lanes;
}

MENINAS_WIDE_LANES
LaneIndices faces_of(const HitPacket& hits) {
  LaneIndices faces;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const std::uint32_t face = 2 * hits.triangle[k] + (hits.front[k] != 0 ? 0U : 1U);
    faces[k] = hits.triangle[k] == index(none<TriangleId>) ? index(none<TriangleId>) : face;
  }
  return faces;
}

MENINAS_WIDE_LANES
LanePoints land_on_quad(const LightScene& light, const ElementTable& lookup, const FaceRecord& face,
                        const HitPacket& hits, std::uint32_t lanes) {
  const SideRecord& side = lookup.sides[face.side];
  LanePoints at;
  if (face.map != UvMap::general) {
    const glm::vec2 uv0 = face.uv0, uv1 = face.uv1, uv2 = face.uv2;
    for (std::size_t k = 0; k < packet_size; ++k)
      at.s[k] = uv0.x + hits.b1[k] * uv1.x + hits.b2[k] * uv2.x;
    for (std::size_t k = 0; k < packet_size; ++k)
      at.t[k] = uv0.y + hits.b1[k] * uv1.y + hits.b2[k] * uv2.y;
    if (face.map == UvMap::bilinear)
      for (std::size_t k = 0; k < packet_size; ++k) {
        const glm::vec2 uv = bilinear_uv(face.widening, {at.s[k], at.t[k]});
        at.s[k] = uv.x;
        at.t[k] = uv.y;
      }
  } else {
    at.s.fill(0.0F);
    at.t.fill(0.0F);
    for_each_lane(lanes, [&](std::uint32_t k) {
      const glm::vec2 uv = uv_of(light, face, hits, k);
      at.s[k] = uv.x;
      at.t[k] = uv.y;
    });
  }
  const std::int32_t nu = side.nu, nv = side.nv;
  const auto fu = static_cast<float>(nu), fv = static_cast<float>(nv);
  const std::uint32_t first = side.first_element;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const float u = within_unit(at.s[k]) * fu, v = within_unit(at.t[k]) * fv;
    const auto iu = static_cast<std::int32_t>(u), iv = static_cast<std::int32_t>(v);
    const std::int32_t i = iu < nu ? iu : nu - 1, j = iv < nv ? iv : nv - 1;
    at.s[k] = u - static_cast<float>(i);
    at.t[k] = v - static_cast<float>(j);
    at.element[k] = first + static_cast<std::uint32_t>(j * nu + i);
  }
  if (side.divided)
    for_each_lane(lanes, [&](std::uint32_t k) {
      const Landing found =
          descend(lookup, false, {at.element[k], glm::vec2(at.s[k], at.t[k])});
      at.element[k] = found.element;
      at.s[k] = found.st.x;
      at.t[k] = found.st.y;
    });
  return at;
}

/// The lanes of one element: which they are, and their sums.
struct ElementLanes {
  std::uint32_t lanes;
  PointSums sums;
};

static inline ElementLanes lanes_on(const AllBits& elements, std::uint32_t element,
                                    const AllFloats& all_s, const AllFloats& all_t) {
  const AllBits is_here = elements == static_cast<std::int32_t>(element);
  const AllFloats none{};
  const AllFloats s = is_here ? all_s : none, t = is_here ? all_t : none;
  const std::uint32_t lanes = lanes_where(is_here);
  return {lanes, {static_cast<float>(std::popcount(lanes)), sum_of(s), sum_of(t), sum_of(s * t)}};
}

MENINAS_WIDE_LANES
glm::vec3 quad_radiance(const VisibleLight& visible, std::uint32_t side,
                        const LanePoints& at, std::uint32_t lanes) {
  alignas(64) LaneIndices elements = at.element;
  if (lanes != all_lanes)
    for (std::size_t k = 0; k < packet_size; ++k)
      elements[k] = (lanes & lane_bits[k]) != 0 ? elements[k] : index(none<ElementId>);
  AllBits all;
  AllFloats s, t;
  load(all, elements);
  load(s, at.s);
  load(t, at.t);
  const auto count = static_cast<float>(std::popcount(lanes));
  glm::vec3 irradiance(0.0F);
  while (lanes != 0) {
    const std::uint32_t element = elements[static_cast<std::size_t>(std::countr_zero(lanes))];
    const ElementLanes here = lanes_on(all, element, s, t);
    lanes &= ~here.lanes;
    irradiance += field_irradiance(visible.corners, visible.irradiance, element, here.sums);
  }
  const SideShading& shading = visible.shading[side];
  return count * shading.emitted + shading.albedo_over_pi * irradiance;
}

} // namespace meninas
