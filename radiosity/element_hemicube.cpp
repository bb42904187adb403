#include "radiosity/element_hemicube.h"

#include <algorithm>
#include <array>

namespace meninas {

std::optional<Point3> hemicube_position(const ReceiverArea& element, CoveredCells covered) {
  if (covered == 0)
    return point_in(element, Vec2(element.triangle ? 1.0 / 3.0 : 0.5));
  // Not at the foot, where there is something else.
  const CoveredCells foot = cells_at_foot(covered);
  const CoveredCells out = (covered | foot) == wholly_covered ? covered : covered | foot;
  std::array<Point3, 64> exposed;
  std::size_t count = 0;
  Point3 middle(0.0);
  for (std::uint32_t cell = 0; cell < 64; ++cell) {
    const Vec2 st = (Vec2(cell / 8, cell % 8) + 0.5) / 8.0;
    if (contains(out, st))
      continue;
    exposed[count] = point_in(element, st);
    middle += exposed[count++];
  }
  if (count == 0)
    return std::nullopt;
  middle /= static_cast<double>(count);
  return *std::min_element(exposed.begin(), exposed.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const Point3& a, const Point3& b) {
                             return glm::distance(a, middle) < glm::distance(b, middle);
                           });
}

DirectionNet make_coverage_net() { return make_direction_net(256); }

void gather_element(const LightScene& light, const Hemicube& cube, const DirectionNet& coverage,
                    const ReceiverArea& element, std::uint32_t seed,
                    const FormFactorSettings& settings, GatherWorkspace& work) {
  const Covered covered = covered_part(light, coverage, element, seed, settings, work);
  const std::uint64_t spent = work.result.traced;
  const auto position = hemicube_position(element, covered.cells);
  if (position) {
    ReceiverArea point;
    point.corner = *position;
    point.normal = element.normal;
    point.plane_class = element.plane_class;
    point.tangent = element.tangent;
    point.coat = element.coat;
    gather_rays(light, cube, point, settings, work);
  } else {
    work.result.clear();
    work.result.rays = work.result.black = work.result.covered_rays =
        static_cast<double>(cube.cells);
    work.result.black_light = glm::vec3(static_cast<float>(cube.cells));
  }
  work.result.covered = covered.cells;
  work.result.exposed = covered.exposed;
  work.result.traced += spent;
}

} // namespace meninas
