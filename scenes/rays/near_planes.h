// The planes that come near a surface: a point of it that is off all of them touches nothing else.
//
// This test takes sixteen rays at a time and spares a search for contacts per ray (careful_rays.h).
//
// Rays start a lift off the plane they leave (lanes.h). A face that crosses that plane at the angle a
// is passed by the lift within lift / sin a of the line where they cross: of a pane that rounding has
// tilted by 20 um against the sheet behind it that is a fifth. A ray that has passed the wall of a closed room meets the
// backs of faces, which shows the error. A ray that has passed a sheet between two rooms meets fronts. So rays that leave
// such planes are traced with care. Limits: of planes beyond those that are tested (the largest ones: 2e7 triangles beside
// planes), and of neighbours of one plane beyond the first 65, it is not known whether they cross.
#pragma once

#include "scenes/rays/frame_geometry.h"
#include "scenes/rays/lanes.h"

namespace meninas {

/// The points whose height over the plane through 0 of the normal (x,
/// y, z) is within `half_width` of `height`.
struct Slab {
  float x = 0.0F, y = 0.0F, z = 0.0F;
  float height = 0.0F, half_width = 0.0F;
};

/// By plane class, the slabs outside of which a point of its surfaces touches nothing else.
struct NearPlanes {
  static constexpr std::uint32_t unknown = no_index;

  struct Range {
    std::uint32_t begin = 0, end = unknown;
  };
  std::vector<Range> ranges;
  std::vector<Slab> slabs;
  std::vector<std::uint8_t> is_grazed; ///< by plane class: crossed by another face at a small angle
  bool any_grazed = false;
};

/// Slabs around all that comes within `reach` of a surface.
/// Where that is too much to look for, or too many planes to be worth a test, it is left unknown.
NearPlanes find_near_planes(const FrameGeometry& geometry, double reach);

/// The lanes among `asked` whose origin,
/// on the plane its ray leaves, certainly touches nothing else.
std::uint32_t lanes_off_all_else(const NearPlanes& near, const RayPacket& packet,
                                 std::uint32_t asked);

/// The lanes whose origin, on a plane that is crossed at a small angle, may touch what crosses it.
std::uint32_t lanes_at_grazing_faces(const NearPlanes& near, const RayPacket& packet);

} // namespace meninas
