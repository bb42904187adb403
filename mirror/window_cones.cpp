#include "mirror/window_cones.h"

#include <algorithm>

namespace meninas {

/// The planes through x and the edges of an opening.
static void add_cone(const ConvexPolygon& opening, const Point3& x, std::vector<Direction>& sides) {
  const double side = glm::dot(area_vector(opening.span()), opening.vertices[0] - x);
  Vec3 from = opening.vertices[opening.size - 1] - x;
  for (std::size_t k = 0; k < opening.size; ++k) {
    const Vec3 to = opening.vertices[k] - x;
    const Vec3 inward = side > 0.0 ? glm::cross(from, to) : glm::cross(to, from);
    const double length = glm::length(inward);
    if (length > 0.0) // an edge seen end-on bounds nothing
      sides.push_back(inward / length);
    from = to;
  }
}

void find_cones(const SeenWorlds& seen, const Point3& x, WindowCones& cones) {
  cones.sides.clear();
  cones.ends.clear();
  for (const auto& opening : seen.openings) {
    add_cone(opening, x, cones.sides);
    cones.ends.push_back(static_cast<std::uint32_t>(cones.sides.size()));
  }
}

Where where_in_window(const WindowCones& cones, const MirrorWorld& world, const SeenWorld& seen,
                      const Point3& x, const Vec3& to, double radius) {
  if (world.depth == 0)
    return Where::inside;
  const Where behind = where(-signed_distance(world.plane, x + to), radius);
  if (behind == Where::outside)
    return behind;
  Where best = Where::outside;
  for (std::uint32_t k = seen.first; k < seen.last && best != Where::inside; ++k) {
    Where in_cone = Where::inside;
    for (std::uint32_t s = k == 0 ? 0 : cones.ends[k - 1]; s < cones.ends[k]; ++s)
      in_cone = std::min(in_cone, where(glm::dot(cones.sides[s], to), radius));
    best = std::max(best, in_cone);
  }
  return std::min(best, behind);
}

} // namespace meninas
