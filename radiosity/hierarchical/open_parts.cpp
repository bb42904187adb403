#include "radiosity/hierarchical/open_parts.h"

#include "radiosity/vertex_light.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

constexpr int points_looked_at = 32, points_gathering = 4;

OpenPart open_part(const VertexSource& source, ElementId element, CoveredCells covered,
                   PointWorkspace& work) {
  const PointGathering& gathering = source.gathering;
  const ReceiverArea area = receiver_of(gathering.light, element);
  const std::uint32_t seed = hash(index(element), gathering.form_factors.seed, 0x09e4);
  Rgb sum(0.0);
  int looked_at = 0, open = 0;
  for (std::uint32_t number = 0; looked_at < points_looked_at; ++number) {
    const Vec2 sample(sobol2(number, seed, SobolPair::first));
    if (is_covered(covered, sample.x, sample.y))
      continue;
    ++looked_at;
    const Receiver point{point_in(area, sample), area.normal, area.plane_class, Vec3(0.0),
                         area.coat};
    const std::uint32_t own = hash(seed, number);
    if (is_shut_in(gathering.light, gathering.form_factors, point, own, work))
      continue;
    if (open++ < points_gathering)
      sum += indirect_light_at(gathering, point, own, work).indirect().total;
  }
  return {element, double(open) / points_looked_at,
          sum / double(std::clamp(open, 1, points_gathering))};
}

} // namespace

std::vector<OpenPart> open_parts(const VertexSource& source,
                                 std::span<const CoveredCells> covered) {
  constexpr CoveredCells whole = ~CoveredCells{0};
  std::vector<std::uint32_t> in_part;
  for (std::uint32_t e = 0; e < covered.size(); ++e)
    if (covered[e] != 0 && covered[e] != whole)
      in_part.push_back(e);
  std::vector<OpenPart> parts(in_part.size());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    parts[k] = open_part(source, static_cast<ElementId>(in_part[k]), covered[in_part[k]],
                         source.workspaces.local());
  });
  return parts;
}

} // namespace meninas
