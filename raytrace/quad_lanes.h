// Sixteen rays that have landed on one quad side, looked up in the field together.
#pragma once

#include "radiosity/light_scene.h"
#include "raytrace/field_shading.h"
#include "scenes/ray_scene.h"

#include <array>
#include <bit>

namespace meninas {

inline glm::vec2 uv_of(const LightScene& light, const FaceRecord& face, const HitPacket& hits,
                       std::uint32_t k) {
  return landing_uv(face, light.surfaces, hits.triangle[k], hits.b1[k], hits.b2[k]);
}

/// Where on a quad side the lanes have landed: element, and place in it.
struct alignas(64) LanePoints {
  std::array<std::int32_t, packet_size> element;
  std::array<float, packet_size> s, t;
};

/// land(), sixteen at a time.
inline LanePoints land_on_quad(const LightScene& light, const FaceRecord& face,
                               const SideRecord& side, const HitPacket& hits) {
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
    for (std::uint32_t k = 0; k < packet_size; ++k) {
      const glm::vec2 uv = uv_of(light, face, hits, k);
      at.s[k] = uv.x;
      at.t[k] = uv.y;
    }
  }
  const std::int32_t nu = side.nu, nv = side.nv;
  const auto fu = static_cast<float>(nu), fv = static_cast<float>(nv);
  const auto first = static_cast<std::int32_t>(side.first_element);
  for (std::size_t k = 0; k < packet_size; ++k) {
    const float u = (at.s[k] < 0.0F ? 0.0F : at.s[k] > 1.0F ? 1.0F : at.s[k]) * fu;
    const float v = (at.t[k] < 0.0F ? 0.0F : at.t[k] > 1.0F ? 1.0F : at.t[k]) * fv;
    const auto iu = static_cast<std::int32_t>(u), iv = static_cast<std::int32_t>(v);
    const std::int32_t i = iu < nu ? iu : nu - 1, j = iv < nv ? iv : nv - 1;
    at.s[k] = u - static_cast<float>(i);
    at.t[k] = v - static_cast<float>(j);
    at.element[k] = first + j * nu + i;
  }
  if (side.divided)
    for (std::size_t k = 0; k < packet_size; ++k) {
      const Landing found = descend(
          light.landing, false,
          {static_cast<std::uint32_t>(at.element[k]), glm::vec2(at.s[k], at.t[k])});
      at.element[k] = static_cast<std::int32_t>(found.element);
      at.s[k] = found.st.x;
      at.t[k] = found.st.y;
    }
  return at;
}

/// The sum over all lanes, four at a time.
inline float sum_of(const std::array<float, packet_size>& values) {
  std::array<float, 4> sums;
  for (std::size_t k = 0; k < 4; ++k)
    sums[k] = (values[k] + values[k + 4]) + (values[k + 8] + values[k + 12]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The sum of the radiances at the points, with one look-up for each element: the bilinear field is linear in the sums of 1, s, t and s t.
inline glm::vec3 quad_radiance(const ElementMesh& mesh, const VisibleLight& visible,
                               std::uint32_t side, const LanePoints& at) {
  const auto radiance = [&](std::int32_t element, const PointSums& points) {
    return field_radiance(mesh, visible.irradiance, visible.shading[side],
                          static_cast<std::uint32_t>(element), points);
  };
  std::uint32_t differ = 0;
  for (std::size_t k = 0; k < packet_size; ++k)
    differ |= static_cast<std::uint32_t>(at.element[k] ^ at.element[0]);
  if (differ == 0) {
    alignas(64) std::array<float, packet_size> st;
    for (std::size_t k = 0; k < packet_size; ++k)
      st[k] = at.s[k] * at.t[k];
    return radiance(at.element[0], {float{packet_size}, sum_of(at.s), sum_of(at.t), sum_of(st)});
  }
  glm::vec3 sum(0.0F);
  for (std::uint32_t rest = 0xffffU; rest != 0;) {
    const std::int32_t element = at.element[static_cast<std::size_t>(std::countr_zero(rest))];
    PointSums points;
    for (std::size_t k = 0; k < packet_size; ++k) {
      if (at.element[k] != element)
        continue;
      rest &= ~(1U << k);
      points.n += 1.0F;
      points.s += at.s[k];
      points.t += at.t[k];
      points.st += at.s[k] * at.t[k];
    }
    sum += radiance(element, points);
  }
  return sum;
}

} // namespace meninas
