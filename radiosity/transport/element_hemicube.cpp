#include "radiosity/transport/element_hemicube.h"

#include <algorithm>
#include <array>

namespace meninas {

std::optional<Point3> hemicube_position(const LightScene& light, const ReceiverArea& element,
                                        ContactMask covered) {
  if (covered == 0 && element.region == nullptr)
    return point_in(element, Vec2(element.triangle ? 1.0 / 3.0 : 0.5));
  if (covered == wholly_covered)
    return std::nullopt;
  std::array<Point3, 64> exposed;
  Point3 middle(0.0);
  std::uint32_t next = 0;
  for (Point3& point : exposed) {
    const NumberedPlace place = next_open_point(light, element, covered, 0, next);
    next = place.number + 1;
    point = point_in(element, place.st);
    middle += point / double(exposed.size());
  }
  return *std::ranges::min_element(
      exposed, {}, [&](const Point3& point) { return glm::distance(point, middle); });
}

HemisphereSamples make_coverage_net() { return make_direction_net(256); }

void gather_element(const LightScene& light, const HemicubeRays& rays, const ReceiverArea& element,
                    std::uint32_t seed, const FormFactorSettings& settings, GatherWorkspace& work) {
  const auto& [cube, coverage] = rays;
  const Covered covered = covered_part(light, coverage, element, seed, settings, work);
  const std::uint64_t spent = work.result.traced;
  const auto position = hemicube_position(light, element, covered.cells);
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
