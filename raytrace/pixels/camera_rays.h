// Camera rays in the frame of the ray scene, single precision, for packets:
// origin and direction are affine in the picture coordinates, so a ray costs a few multiplications.
// Directions are not of unit length: with A the picture's area by its coordinates (the product of
// the lengths of direction_x and direction_y), a small part a of the picture has the solid angle
//
//   a A / abs(d)^3,
//
// and so it is in panoramas (scenes/camera.h), whose rays are not affine: on the faces of a cube by
// themselves, in an equirectangular picture, where A = 2 pi^2, with abs(d) = cos(latitude)^(-1/3).
//
// Rays through a lens are those through its centre, turned about where they meet the plane of focus.
#pragma once

#include "scenes/camera.h"
#include "scenes/rays/ray_scene.h"

namespace meninas {

struct CameraFrame {
  glm::vec3 origin, origin_x, origin_y; ///< origin(x, y) = origin + x origin_x + y origin_y
  glm::vec3 direction, direction_x,
      direction_y; ///< likewise; x and y run over the picture from 0 to 1, right and down
  float section; ///< of perspective: origin(x, y) = eye + section direction(x, y)
  Projection projection;
  glm::vec3 lens_x, lens_y; ///< the lens, from its centre to its edge; zero: a pinhole
  float focus; ///< depth of the plane of focus
  std::array<glm::mat3, cube_faces> faces; ///< of panoramas: right, up and forward; [0] of the sphere
};

/// Whether all rays are affine in the picture: no panorama, no lens.
inline bool is_affine(const CameraFrame& camera) {
  return !is_panorama(camera.projection) && camera.lens_x == glm::vec3(0.0F);
}

/// Puts the camera rays through sixteen points of the picture into a packet.
void set_camera_rays(RayPacket& packet, const CameraFrame& camera,
                     const std::array<float, packet_size>& x,
                     const std::array<float, packet_size>& y);

/// The same of a panorama; `middle` is that of each point's pixel: a pixel shows one face of a cube.
void set_panorama_rays(RayPacket& packet, const CameraFrame& camera,
                       const std::array<float, packet_size>& x,
                       const std::array<float, packet_size>& y,
                       const std::array<float, packet_size>& middle);

/// Moves the origins to points of the unit disc that stands for the lens.
void start_on_lens(RayPacket& packet, const CameraFrame& camera,
                   const std::array<glm::vec2, packet_size>& points);

CameraFrame make_camera_frame(const Camera& camera, double picture_aspect, const RayFrame& frame);

} // namespace meninas
