// Where a ray has landed: from the hit (triangle, barycentric,
// face) to mirror, element and place in the element, by table look-up alone.
#pragma once

#include "mirror/mirrors.h"
#include "radiosity/mesh/cell_children.h"
#include "radiosity/mesh/element_mesh.h"

#include <array>
#include <cmath>
#include <vector>

namespace meninas {

/// From barycentrics to the (u, v) of a patch.
enum class UvMap : std::uint8_t {
  affine,
  bilinear, ///< of a quad whose opposite sides are not parallel: (x, y) along two of its sides is affine
  general ///< of a sliver, by patch_uv
};

/// One face (front or back) of one triangle, in single precision for the inner loops.
struct FaceRecord {
  static constexpr std::uint32_t nothing = 0xffffffffU;

  std::uint32_t side = nothing; ///< index of a SideId where the face carries radiosity
  bool mirrors = false;         ///< an ideal mirror, enumerated or a facet, or glass
  bool coat = false;            ///< one to the light of surfaces alone, over what it scatters
  UvMap map = UvMap::affine;
  MirrorId mirror = none<MirrorId>;
  std::uint32_t plane_class = nothing;
  glm::vec2 uv0{0.0F};            ///< (u, v), or (x, y), at b = (0, 0)
  glm::vec2 uv1{0.0F}, uv2{0.0F}; ///< and its changes along b1 and b2
  glm::vec2 widening{0.0F};       ///< of a bilinear map: (x, y) = (u, v) + u v widening
  glm::vec3 reflectance{1.0F};    ///< of the mirror, where it is not glass
  bool glass = false;
  bool solid = false; ///< and the surface of a solid
  bool curved = false; ///< it reflects by a normal that turns (scenes/shading_normal.h)
  bool mapped = false; ///< by a texture as well (scenes/materials/normal_map.h); then it is curved
  glm::dvec3 normal{0.0};    ///< towards this face
  double frame_offset = 0.0; ///< of its plane in the frame of the ray scene
};

/// The data of a side that the inner loops need, close together.
struct SideRecord {
  std::uint32_t first_element = 0; ///< its first root cell where cells of it are divided
  std::int32_t nu = 1, nv = 1;
  bool triangle = false;
  bool divided = false;
};

/// A line that cuts a leaf (element_mesh.h): where it is negative at (s, t) `next[0]` goes on.
struct LandingLine {
  std::array<float, 4> line{};
  std::array<std::uint32_t, 2> next{0, 0}; ///< as in `descent`
};

/// From (u, v) of a side to the element.
struct ElementTable {
  /// Marks the element in `descent`, and the line of a leaf that is cut.
  static constexpr std::uint32_t leaf = 0x80000000U, cut = 0x40000000U;

  std::vector<SideRecord> sides; ///< by SideId
  std::vector<std::uint32_t>
      descent; ///< by CellId: `leaf` and the element, `cut` and a line, or the first child; empty when nothing is divided
  std::vector<LandingLine> lines;
};

/// That of a mesh. With `all_divided` every side is looked up by way of its cells.
ElementTable make_element_table(const ElementMesh& mesh, bool all_divided = false);

struct ElementLookup {
  std::vector<FaceRecord> faces; ///< [2 triangle + (0 front, 1 back)]
  ElementTable elements;
};

ElementLookup make_element_lookup(const Scene& scene, const SurfaceModel& surfaces,
                                const MirrorSet& mirrors, const ElementMesh& mesh,
                                Point3 frame_centre, double frame_scale);

/// (u, v) of the point (x, y) of a quad: v is the root of  v (1 + u w_y) = y  with  u (1 + v w_x) = x,  that is of
///   w_x v^2 + (1 + w_y x - w_x y) v - y = 0,
/// at which the polynomial rises. Its slope there is the root of the discriminant, 1 + u w_y + v
/// w_x; with the linear term it makes 2 (1 + u w_y), which is positive all over the quad.
inline glm::vec2 bilinear_uv(const glm::vec2& w, const glm::vec2& xy) {
  const float linear = 1.0F + w.y * xy.x - w.x * xy.y;
  const float squared = linear * linear + 4.0F * w.x * xy.y;
  const float slope = std::sqrt(squared > 0.0F ? squared : 0.0F);
  const float v = 2.0F * xy.y / (linear + slope);
  return {xy.x / (1.0F + v * w.x), v};
}

/// (u, v) of a hit on a sliver in its patch.
glm::vec2 general_uv(const SurfaceModel& surfaces, std::uint32_t triangle, float b1, float b2);

/// (u, v) of a hit in its patch.
inline glm::vec2 hit_uv(const FaceRecord& face, const SurfaceModel& surfaces,
                            std::uint32_t triangle, float b1, float b2) {
  if (face.map == UvMap::general)
    return general_uv(surfaces, triangle, b1, b2);
  const glm::vec2 at = face.uv0 + b1 * face.uv1 + b2 * face.uv2;
  return face.map == UvMap::affine ? at : bilinear_uv(face.widening, at);
}

/// Index of the element at (u, v) and the place (s, t) in it; locate() in single precision.
struct Landing {
  std::uint32_t element;
  glm::vec2 st;
};

/// From a root cell of a divided side to the element.
inline Landing descend(const ElementTable& table, bool triangle, Landing root) {
  std::uint32_t at = table.descent[root.element];
  while ((at & ElementTable::leaf) == 0) {
    if ((at & ElementTable::cut) != 0) {
      const LandingLine& line = table.lines[at & ~ElementTable::cut];
      const float height = line.line[0] + line.line[1] * root.st.x + line.line[2] * root.st.y +
                           line.line[3] * root.st.x * root.st.y;
      at = line.next[height >= 0.0F ? 1 : 0];
      continue;
    }
    const ChildPoint<glm::vec2> child = child_at(root.st, triangle);
    at = table.descent[at + child.child];
    root.st = child.st;
  }
  return {at & ~ElementTable::leaf, root.st};
}

/// The element, or the root cell of a divided side.
inline Landing land_on_root(const SideRecord& side, glm::vec2 uv) {
  const float fu = within_unit(uv.x) * static_cast<float>(side.nu);
  const float fv = within_unit(uv.y) * static_cast<float>(side.nv);
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

inline Landing land(const ElementTable& table, std::uint32_t side, glm::vec2 uv) {
  const SideRecord& record = table.sides[side];
  const Landing at = land_on_root(record, uv);
  return record.divided ? descend(table, record.triangle, at) : at;
}

} // namespace meninas
