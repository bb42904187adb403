#include "radiosity/field/view/curve_places.h"

#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/field/view/view_receivers.h"
#include "radiosity/mesh/mesh_cells.h"

namespace meninas {

CurvePlaces::CurvePlaces(const LightScene& light, const LatticeCells& cells)
    : light_(light), cells_(cells), welder_(vertex_grain(light.mesh, light.surfaces)) {}

void CurvePlaces::find_new() {
  while (firsts_.size() < cells_.vertices().size())
    firsts_.push_back(first_at(static_cast<std::uint32_t>(firsts_.size())));
}

std::uint32_t CurvePlaces::first_at(std::uint32_t vertex) {
  const LatticeVertex& own = cells_.vertices()[vertex];
  if (!cells_.is_at_border(own) || cells_.stands_apart(own.element))
    return vertex;
  const Receiver receiver = receiver_of(light_, cells_, own);
  if (!is_on_curve(receiver))
    return vertex;
  const std::uint32_t place = index(welder_.vertex_at(0, place_of(light_, cells_, own), places_));
  const auto [begin, end] = at_place_.equal_range(place);
  std::uint32_t first = vertex;
  for (auto other = begin; other != end; ++other)
    if (is_one_curve(other->second.receiver, receiver))
      first = std::min(first, other->second.vertex);
  if (first == vertex)
    at_place_.emplace(place, First{vertex, receiver});
  return first;
}

} // namespace meninas
