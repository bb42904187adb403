#include "radiosity/hierarchical/open_parts.h"

#include "radiosity/element_light.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

namespace meninas {

namespace {

constexpr int points_gathering = 4;

OpenPart open_part(const VertexSource& source, ElementId element, CoveredCells covered,
                   PointWorkspace& work) {
  const PointGathering& gathering = source.gathering;
  const ReceiverArea area = receiver_of(gathering.light, element);
  const std::uint32_t seed = hash(index(element), gathering.form_factors.seed, 0x09e4);
  Rgb sum(0.0);
  std::uint32_t next = 0;
  for (int k = 0; k < points_gathering; ++k) {
    const NumberedPlace place = exposed_place(gathering.light, area, covered, seed, next);
    next = place.number + 1;
    const Receiver point{point_in(area, place.st), area.normal, area.plane_class, Vec3(0.0),
                         area.coat};
    sum += indirect_light_at(gathering, point, hash(seed, place.number), work).indirect().total;
  }
  SharedLightWorkspace shared;
  const ArrivingLight direct =
      direct_irradiance(gathering.light, element, covered, gathering.direct, shared);
  work.direct.shadow_rays += shared.point.shadow_rays;
  return {element, direct.total, sum / double(points_gathering)};
}

} // namespace

std::vector<OpenPart> open_parts(const VertexSource& source, std::span<const std::uint8_t> asked,
                                 std::span<const CoveredCells> covered) {
  std::vector<std::uint32_t> in_part;
  for (std::uint32_t e = 0; e < covered.size(); ++e)
    if (asked[e] != 0 && covered[e] != wholly_covered)
      in_part.push_back(e);
  std::vector<OpenPart> parts(in_part.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    parts[k] = open_part(source, static_cast<ElementId>(in_part[k]), covered[in_part[k]],
                         source.workspaces.local());
  });
  return parts;
}

} // namespace meninas
