#include "raytrace/pixels/camera_rays.h"

#include "raytrace/wide_lanes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

static glm::mat3 columns(const Direction& right, const Direction& up, const Direction& forward) {
  return {glm::vec3(right), glm::vec3(up), glm::vec3(forward)};
}

/// Whose direction_x and direction_y are there for their lengths.
static CameraFrame panorama_frame(const Camera& camera, const Point3& eye) {
  CameraFrame rays{};
  rays.projection = camera.projection;
  rays.origin = eye;
  rays.direction = camera.forward;
  const bool cube = camera.projection == Projection::cube;
  rays.direction_x = (cube ? 2.0 * cube_faces : 2.0 * std::numbers::pi) * camera.right;
  rays.direction_y = (cube ? -2.0 : -std::numbers::pi) * camera.up;
  rays.faces[0] = columns(camera.right, camera.up, camera.forward);
  for (int k = 0; cube && k < cube_faces; ++k) {
    const CubeFace face = cube_face(camera, k);
    rays.faces[static_cast<std::size_t>(k)] = columns(face.right, face.up, face.forward);
  }
  return rays;
}

CameraFrame make_camera_frame(const Camera& camera, double picture_aspect, const RayFrame& frame) {
  const Point3 eye = (camera.position - frame.centre) * frame.scale;
  if (is_panorama(camera.projection))
    return panorama_frame(camera, eye);
  CameraFrame rays{};
  rays.projection = camera.projection;
  if (camera.projection == Projection::perspective) {
    // The picture plane at distance one: from its upper left corner, right by x and down by y.
    const double half_height = half_height_of(camera, picture_aspect),
                 half_width = half_height * picture_aspect;
    rays.lens_x = camera.lens_radius * frame.scale * camera.right;
    rays.lens_y = camera.lens_radius * frame.scale * camera.up;
    rays.focus = static_cast<float>(camera.focus_distance * frame.scale);
    rays.direction = camera.forward - half_width * camera.right + half_height * camera.up;
    rays.direction_x = 2.0 * half_width * camera.right;
    rays.direction_y = -2.0 * half_height * camera.up;
    rays.origin = eye;
    if (const double section = camera.section * frame.scale; section > 0.0) {
      rays.section = static_cast<float>(section);
      rays.origin += rays.section * rays.direction;
      rays.origin_x = rays.section * rays.direction_x;
      rays.origin_y = rays.section * rays.direction_y;
    }
    return rays;
  }
  const double half_height = half_height_of(camera, picture_aspect) * frame.scale,
               half_width = half_height * picture_aspect;
  rays.origin = eye - half_width * camera.right + half_height * camera.up +
                camera.section * frame.scale * camera.forward;
  rays.origin_x = 2.0 * half_width * camera.right;
  rays.origin_y = -2.0 * half_height * camera.up;
  rays.direction = camera.forward;
  return rays;
}

static void set_limits(RayPacket& packet) {
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
  std::fill_n(packet.leaving, packet_size, index(none<PlaneId>));
}

MENINAS_WIDE_LANES
void set_camera_rays(RayPacket& packet, const CameraFrame& camera,
                     const std::array<float, packet_size>& x,
                     const std::array<float, packet_size>& y) {
  const CameraFrame c = camera;
  for (std::size_t k = 0; k < packet_size; ++k) {
    packet.origin_x[k] = c.origin.x + x[k] * c.origin_x.x + y[k] * c.origin_y.x;
    packet.origin_y[k] = c.origin.y + x[k] * c.origin_x.y + y[k] * c.origin_y.y;
    packet.origin_z[k] = c.origin.z + x[k] * c.origin_x.z + y[k] * c.origin_y.z;
  }
  for (std::size_t k = 0; k < packet_size; ++k) {
    packet.direction_x[k] = c.direction.x + x[k] * c.direction_x.x + y[k] * c.direction_y.x;
    packet.direction_y[k] = c.direction.y + x[k] * c.direction_x.y + y[k] * c.direction_y.y;
    packet.direction_z[k] = c.direction.z + x[k] * c.direction_x.z + y[k] * c.direction_y.z;
  }
  set_limits(packet);
}

/// In right, up and forward.
static glm::vec3 around_sphere(float x, float y) {
  constexpr float pi = std::numbers::pi_v<float>;
  constexpr float pole = 1e-4F; // nearer, beams are as wide as there
  const float longitude = pi * (2.0F * x - 1.0F), latitude = pi * (0.5F - y);
  const float cosine = std::cos(latitude);
  const glm::vec3 direction{cosine * std::sin(longitude), std::sin(latitude),
                            cosine * std::cos(longitude)};
  return direction / std::cbrt(std::max(pole, std::abs(cosine)));
}

void set_panorama_rays(RayPacket& packet, const CameraFrame& camera,
                       const std::array<float, packet_size>& x,
                       const std::array<float, packet_size>& y,
                       const std::array<float, packet_size>& middle) {
  constexpr std::uint32_t nowhere = index(none<PlaneId>); // that rays leave
  for (std::uint32_t k = 0; k < packet_size; ++k) {
    if (camera.projection == Projection::equirectangular) {
      set_ray(packet, k, camera.origin, camera.faces[0] * around_sphere(x[k], y[k]), nowhere);
      continue;
    }
    const float whole = static_cast<float>(cube_faces);
    const float face = std::clamp(std::floor(whole * middle[k]), 0.0F, whole - 1.0F);
    const glm::vec3 on_face{2.0F * (whole * x[k] - face) - 1.0F, 1.0F - 2.0F * y[k], 1.0F};
    set_ray(packet, k, camera.origin, camera.faces[static_cast<std::size_t>(face)] * on_face,
            nowhere);
  }
}

void start_on_lens(RayPacket& packet, const CameraFrame& camera,
                   const std::array<glm::vec2, packet_size>& points) {
  const float turn = 1.0F / camera.focus, shift = 1.0F - camera.section * turn;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const glm::vec3 offset = points[k].x * camera.lens_x + points[k].y * camera.lens_y;
    packet.origin_x[k] += shift * offset.x;
    packet.origin_y[k] += shift * offset.y;
    packet.origin_z[k] += shift * offset.z;
    packet.direction_x[k] -= turn * offset.x;
    packet.direction_y[k] -= turn * offset.y;
    packet.direction_z[k] -= turn * offset.z;
  }
}

} // namespace meninas
