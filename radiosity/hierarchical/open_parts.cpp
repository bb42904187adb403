#include "radiosity/hierarchical/open_parts.h"

#include "radiosity/vertex_light.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

namespace meninas {

namespace {

constexpr int points_in_part = 4; // that are looked at

std::optional<Rgb> light_in_part(const VertexSource& source, ElementId element,
                                 CoveredCells covered, PointWorkspace& work) {
  const LightScene& light = source.gathering.light;
  const ReceiverArea area = receiver_of(light, element);
  const double size = size_of(light.mesh, element);
  const std::uint32_t seed = hash(index(element), source.gathering.form_factors.seed, 0x09e4);
  Rgb sum(0.0);
  int open = 0;
  for (std::uint32_t number = 0, looked = 0; looked < points_in_part; ++number) {
    const Vec2 sample(sobol2(number, seed, SobolPair::first));
    if (is_covered(covered, sample.x, sample.y))
      continue;
    ++looked;
    const Receiver point{point_in(area, sample), area.normal, area.plane_class, Vec3(0.0),
                         area.coat};
    const VertexValue value =
        value_at(source.gathering, source.irradiance, point, size, hash(seed, number), work);
    if (value.cover == Cover::shut)
      continue;
    sum += value.irradiance.total;
    ++open;
  }
  return open > 0 ? std::optional(sum / double(open)) : std::nullopt;
}

} // namespace

std::vector<std::optional<Rgb>> light_in_open_parts(const VertexSource& source,
                                                    std::span<const CoveredCells> covered) {
  constexpr CoveredCells whole = ~CoveredCells{0};
  std::vector<std::optional<Rgb>> lights(covered.size());
  std::vector<std::size_t> parts;
  for (std::size_t e = 0; e < covered.size(); ++e)
    if (covered[e] != 0 && covered[e] != whole)
      parts.push_back(e);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
    lights[parts[k]] = light_in_part(source, static_cast<ElementId>(parts[k]), covered[parts[k]],
                                     source.workspaces.local());
  });
  return lights;
}

} // namespace meninas
