// The first hit of the ray through one point of the picture, followed by ideal mirrors where that is wanted:
// for layers and views that show the scene instead of its light.
#pragma once

#include "raytrace/field_shading.h"

#include <optional>

namespace meninas {

/// Where a line of sight ends.
struct Sight {
  TriangleId triangle = none<TriangleId>; ///< none: nothing is met
  Vec2 barycentric{0.0};
  Point3 position{0.0};
  Direction normal{0.0}; ///< by which what is met reflects towards the eye: of the face or the curve
  std::uint32_t side = FaceRecord::nothing; ///< index of the SideId, if the face carries radiosity
  glm::vec2 uv{0.0F};                       ///< in the patch of that side
  FieldPoint place{};                       ///< on that side
  int mirrors = 0;                          ///< on the way
  double distance = 0.0; ///< from the eye, metres, unfolded at the mirrors
};

/// The eye looks straight through glass that is mostly clear.
/// The sight through a point of the picture (x and y from 0 to 1, right and down).
/// Backs of single-sided surfaces are looked through by the eye, not by mirrors.
/// A chain of more than `max_mirrors` ends at the mirror it has come to.
Sight look(const LightScene& light, const Camera& camera, double picture_aspect, Vec2 at,
           int max_mirrors);

/// The step of a sight where it meets a face: it ends, goes on through mostly clear glass, or is reflected.
enum class SightStep { end, through, mirror };
SightStep sight_step(const LightScene& light, const FaceRecord& face, const Hit& hit);

/// The normal by which a face reflects towards where a ray comes from: its own, or that of its curve
/// (Phong 1975).
Direction seen_normal(const LightScene& light, const FaceRecord& face, const Hit& hit,
                      const Vec3& along);

/// A place on a side of a patch.
struct PatchPlace {
  std::uint32_t side; ///< index of the SideId
  glm::vec2 uv;
};

/// The same place on the other side of a translucent surface; none of others.
std::optional<PatchPlace> place_behind(const LightScene& light, SideId side, TriangleId triangle,
                                       Vec2 barycentric);

/// rho_d, dimensionless, at the end of a sight, textures included; 0 where no diffuse surface is met.
Rgb albedo_at(const LightScene& light, const Sight& sight);

} // namespace meninas
