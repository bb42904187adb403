// Camera rays in the frame of the ray scene, single precision, for packets:
// origin and direction are affine in the picture coordinates, so a ray costs a few multiplications.
// Directions are not of unit length.
#pragma once

#include "scenes/camera.h"
#include "scenes/rays/ray_scene.h"

namespace meninas {

struct CameraFrame {
  glm::vec3 origin, origin_x, origin_y; ///< origin(x, y) = origin + x origin_x + y origin_y
  glm::vec3 direction, direction_x,
      direction_y; ///< likewise; x and y run over the picture from 0 to 1, right and down
  float section; ///< of perspective: origin(x, y) = eye + section direction(x, y)
};

/// Puts the camera rays through sixteen points of the picture into a packet.
void set_camera_rays(RayPacket& packet, const CameraFrame& camera,
                     const std::array<float, packet_size>& x,
                     const std::array<float, packet_size>& y);

CameraFrame make_camera_frame(const Camera& camera, double picture_aspect, const RayFrame& frame);

} // namespace meninas
