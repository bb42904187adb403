#include "raytrace/pixels/camera_rays.h"

#include "raytrace/wide_lanes.h"

#include <algorithm>
#include <cmath>

namespace meninas {

CameraFrame make_camera_frame(const Camera& camera, double picture_aspect, const RayFrame& frame) {
  const Point3 eye = (camera.position - frame.centre) * frame.scale;
  CameraFrame rays{};
  if (camera.projection == Projection::perspective) {
    // The picture plane at distance one: from its upper left corner, right by x and down by y.
    const double half_height = std::tan(0.5 * camera.vertical_fov),
                 half_width = half_height * picture_aspect;
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
  const double half_height = camera.half_height * frame.scale,
               half_width = half_height * picture_aspect;
  rays.origin = eye - half_width * camera.right + half_height * camera.up +
                camera.section * frame.scale * camera.forward;
  rays.origin_x = 2.0 * half_width * camera.right;
  rays.origin_y = -2.0 * half_height * camera.up;
  rays.direction = camera.forward;
  return rays;
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
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
  std::fill_n(packet.leaving, packet_size, index(none<PlaneId>));
}

} // namespace meninas
