#include "radiosity/field/curves/facet_edges.h"

#include "radiosity/field/curves/smoothing_groups.h"
#include "radiosity/field/vertex_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

namespace meninas {

namespace {

double sum_of_bands(const Rgb& light) { return light.r + light.g + light.b; }

/// V; none where the source would bring nothing.
std::optional<double> visible_part(const VertexSource& source, const Receiver& receiver,
                                   std::uint32_t seed) {
  PointWorkspace& work = source.workspaces.local();
  const ArrivingLight light = direct_light_at(source.gathering, receiver, seed, work);
  const double unblocked = sum_of_bands(unblocked_irradiance(source.gathering.light, work.direct));
  if (!(unblocked > 0.0))
    return std::nullopt;
  return sum_of_bands(light.total - light.punctual) / unblocked;
}

/// max V - min V over the corners.
double unevenly_seen(const VertexSource& source, std::uint32_t level, const VertexSamples& found,
                     ElementId facet) {
  std::optional<double> least, most;
  for (const ElementVertexId corner : found.mesh.corners[index(facet)]) {
    const auto visible = visible_part(source, found.receivers[index(corner)],
                                      vertex_seed(source, index(corner), level));
    if (!visible)
      continue;
    least = std::min(least.value_or(*visible), *visible);
    most = std::max(most.value_or(*visible), *visible);
  }
  return most ? *most - *least : 0.0;
}

} // namespace

std::vector<ElementId> faces_with_shadow_edges(const LightScene& light, const VertexSource& source,
                                         std::uint32_t level, const VertexSamples& found,
                                         std::span<const ElementId> facets) {
  constexpr double max_unevenness = 0.1;
  if (facets.empty())
    return {};
  const std::vector<std::uint8_t> turn =
      sides_above_crease_angle(light.mesh, facets_around(light), max_smooth_turn);
  std::vector<std::uint8_t> has_edge(facets.size(), 0);
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t k) {
    has_edge[k] = turn[index(found.mesh.side_of_element[index(facets[k])])] != 0 ||
                          unevenly_seen(source, level, found, facets[k]) > max_unevenness
                      ? 1
                      : 0;
  });
  std::vector<ElementId> result;
  for (std::size_t k = 0; k < facets.size(); ++k)
    if (has_edge[k] != 0)
      result.push_back(facets[k]);
  return result;
}

} // namespace meninas
