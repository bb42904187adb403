// Where a ray has landed: from the hit (triangle, barycentric, face) to mirror, element and place in the element, by table look-up alone.
#pragma once

#include "mirror/mirrors.h"
#include "radiosity/element_mesh.h"

#include <vector>

namespace meninas {

/// One face (front or back) of one triangle, in single precision for the inner loops.
struct FaceRecord {
  static constexpr std::uint32_t nothing = 0xffffffffU;

  std::uint32_t side = nothing; ///< index of a SideId where the face carries radiosity
  bool mirrors = false;         ///< an ideal mirror, enumerated or a facet
  bool affine = true;           ///< (u, v) is affine in the barycentrics
  MirrorId mirror = none<MirrorId>;
  std::uint32_t plane_class = nothing;
  glm::vec2 uv0{0.0F}, uv1{0.0F},
      uv2{0.0F};               ///< (u, v) at b = (0, 0), and its changes along b1 and b2
  glm::vec3 reflectance{1.0F}; ///< of the mirror
  glm::dvec3 normal{0.0};      ///< towards this face
  double frame_offset = 0.0;   ///< of its plane in the frame of the ray scene
};

/// What the inner loops need of a side, close together.
struct SideRecord {
  std::uint32_t first_element = 0;
  std::int32_t nu = 1, nv = 1;
  bool triangle = false;
};

struct LandingTable {
  std::vector<FaceRecord> faces; ///< [2 triangle + (0 front, 1 back)]
  std::vector<SideRecord> sides; ///< by SideId
};

LandingTable make_landing_table(const Scene& scene, const SurfaceModel& surfaces,
                                const MirrorSet& mirrors, const ElementMesh& mesh,
                                Point3 frame_centre, double frame_scale);

/// (u, v) of a hit in its patch.
glm::vec2 landing_uv(const FaceRecord& face, const SurfaceModel& surfaces, std::uint32_t triangle,
                     float b1, float b2);

/// Index of the element at (u, v) and the place (s, t) in it; locate() in single precision.
struct Landing {
  std::uint32_t element;
  glm::vec2 st;
};
inline Landing land(const SideRecord& side, glm::vec2 uv) {
  const float fu = glm::clamp(uv.x, 0.0F, 1.0F) * static_cast<float>(side.nu);
  const float fv = glm::clamp(uv.y, 0.0F, 1.0F) * static_cast<float>(side.nv);
  if (!side.triangle) {
    const int i = glm::min(static_cast<int>(fu), side.nu - 1);
    const int j = glm::min(static_cast<int>(fv), side.nv - 1);
    return {side.first_element + static_cast<std::uint32_t>(j * side.nu + i),
            {fu - static_cast<float>(i), fv - static_cast<float>(j)}};
  }
  const int n = side.nu;
  const int j = glm::min(static_cast<int>(fv), n - 1);
  const int i = glm::min(static_cast<int>(fu), n - 1 - j);
  const float s = fu - static_cast<float>(i), t = fv - static_cast<float>(j);
  const bool upper = s + t > 1.0F && i + j < n - 1;
  const auto local = static_cast<std::uint32_t>(j * (2 * n - j) + 2 * i + (upper ? 1 : 0));
  return {side.first_element + local, upper ? glm::vec2(1.0F - s, 1.0F - t) : glm::vec2(s, t)};
}

} // namespace meninas
