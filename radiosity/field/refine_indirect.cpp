#include "radiosity/field/refine_indirect.h"

#include "radiosity/field/curves/curved_vertices.h"
#include "radiosity/mesh/subdivision.h"

#include <algorithm>

namespace meninas {

VertexSamples divided(const LightScene& light, const VertexSamples& before,
                      std::span<const std::uint8_t> marked) {
  VertexSamples after = make_samples(divide_elements(before.mesh, light.surfaces, marked));
  receive_on_curves(light, after);
  make_room_for_lamps(light, after);
  const std::vector<CellId> now = same_cells(before.mesh, after.mesh);
  for (std::size_t e = 0; e < element_count(before.mesh); ++e) {
    const ElementCorners corners =
        same_corners(before.mesh, static_cast<ElementId>(e), after.mesh,
                     now[index(before.mesh.cell_of_element[e])]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (corners[c] == none<ElementVertexId>)
        continue;
      const std::uint32_t from = index(before.mesh.corners[e][c]), to = index(corners[c]);
      after.states[to] = before.states[from];
      after.seen[to] = before.seen[from];
      after.field.irradiance[to] = before.field.irradiance[from];
      after.field.mirrored[to] = before.field.mirrored[from];
      after.field.indirect[to] = before.field.indirect[from];
      after.field.indirect_mirrored[to] = before.field.indirect_mirrored[from];
      for (std::size_t l = 0; l < after.field.by_lamp.size(); ++l) {
        after.field.by_lamp[l].direct[to] = before.field.by_lamp[l].direct[from];
        after.field.by_lamp[l].indirect[to] = before.field.by_lamp[l].indirect[from];
      }
    }
  }
  return after;
}

void refine_indirect(const LightScene& light, const VertexSource& source, const BendScale& scale,
                 double x, VertexSamples& found, InterpolatedField& result) {
  constexpr std::uint32_t max_divisions = 3;
  for (std::uint32_t level = 1; level <= max_divisions && x > 0.0; ++level) {
    const auto marked =
        bent_by_more(interpolation_error(found.mesh, result.field.indirect, scale), x);
    if (std::ranges::find(marked, 1) == marked.end())
      return;
    found = divided(light, found, marked);
    gather_at_vertices(source, level, found);
    result.field = complete_field(source, found);
    result.mesh = found.mesh;
  }
}

} // namespace meninas
