#include "radiosity/hierarchical/open_parts.h"

#include "radiosity/element_light.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

namespace meninas {

namespace {

constexpr int points_gathering = 4;

/// The part's light that does not come from the source.
Rgb indirect_in_part(const PointGathering& gathering, ElementId element, CoveredCells covered,
                     PointWorkspace& work) {
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
  return sum / double(points_gathering);
}

Rgb from_source_in_part(const PointGathering& gathering, ElementId element, CoveredCells covered,
                        PointWorkspace& work) {
  SharedLightWorkspace shared;
  const ArrivingLight direct =
      direct_irradiance(gathering.light, element, covered, gathering.direct, shared);
  work.direct.shadow_rays += shared.point.shadow_rays;
  return direct.total;
}

} // namespace

std::vector<OpenPart> open_parts(const VertexSource& source, const SourceOfElements& known,
                                 std::span<const std::uint8_t> asked,
                                 std::span<const CoveredCells> covered) {
  std::vector<std::uint32_t> in_part;
  for (std::uint32_t e = 0; e < covered.size(); ++e)
    if (asked[e] != 0 && covered[e] != wholly_covered)
      in_part.push_back(e);
  std::vector<OpenPart> parts(in_part.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    const std::uint32_t e = in_part[k];
    const ElementId element{e};
    PointWorkspace& work = source.workspaces.local();
    parts[k] = {element,
                known.shared[e] == 0
                    ? known.light[e]
                    : from_source_in_part(source.gathering, element, covered[e], work),
                indirect_in_part(source.gathering, element, covered[e], work)};
  });
  return parts;
}

} // namespace meninas
