#include "radiosity/shadow_edges.h"

#include "radiosity/bent_field.h"
#include "radiosity/mesh_division.h"
#include "radiosity/vertex_fill.h"

#include <algorithm>

namespace meninas {

namespace {

std::vector<glm::vec3> from_source(const DiffuseField& field) {
  std::vector<glm::vec3> light = field.irradiance;
  for (std::size_t v = 0; v < light.size(); ++v)
    light[v] -= field.indirect[v];
  return light;
}

/// Those that are most bent, of which no more than `most` become four.
std::vector<std::uint8_t> most_bent(const ElementMesh& mesh, const std::vector<glm::vec3>& light,
                                    const BendScale& scale, double x, std::size_t most) {
  for (;; x *= 2.0) {
    std::vector<std::uint8_t> marked = bent_elements(mesh, light, scale, x);
    if (static_cast<std::size_t>(std::ranges::count(marked, 1)) <= most)
      return marked;
  }
}

/// What is found so far, for those who add to it: every vertex that has a value has the settled one,
/// and none asks anew how it sees the source.
FoundField kept(FoundField found, const DiffuseField& settled) {
  found.field = settled;
  std::ranges::replace(found.states, VertexState::low, VertexState::gathered);
  std::ranges::replace(found.seen, SourceSeen::alike, SourceSeen::surely_alike);
  return found;
}

/// By ElementVertexId, 1: new, or has hung so far.
std::vector<std::uint8_t> without_value(const FoundField& found) {
  std::vector<std::uint8_t> fresh;
  for (const VertexState state : found.states)
    fresh.push_back(state == VertexState::unknown ? 1 : 0);
  return fresh;
}

/// Light from the source at fresh vertices, and what else is there as the coarser mesh has it.
void light_fresh(const VertexSource& source, const SurfaceModel& surfaces, std::uint32_t level,
                 const FoundField& coarse, const std::vector<std::uint8_t>& fresh,
                 FoundField& found) {
  const ElementMesh& mesh = found.mesh;
  DiffuseField& field = found.field;
  for (std::size_t v = 0; v < fresh.size(); ++v)
    if (fresh[v] != 0)
      field.irradiance[v] = field.mirrored[v] = field.indirect[v] = field.indirect_mirrored[v] =
          glm::vec3(0.0F);
  light_vertices(source, level, found);
  for (std::size_t v = 0; v < fresh.size(); ++v) {
    if (fresh[v] == 0 || found.states[v] != VertexState::lit)
      continue;
    const SideId side = mesh.side_of_element[index(mesh.element_of_vertex[v])];
    const Patch& patch = surfaces.patches[index(mesh.sides[index(side)].patch)];
    const ElementPoint at = locate(coarse.mesh, side, uv_at(patch, mesh.vertices[v]));
    field.indirect[v] = value_in(coarse.mesh, coarse.field.indirect, at);
    field.indirect_mirrored[v] = value_in(coarse.mesh, coarse.field.indirect_mirrored, at);
    field.irradiance[v] += field.indirect[v];
    field.mirrored[v] += field.indirect_mirrored[v];
    found.states[v] = VertexState::gathered;
  }
}

/// Vertices that are left, covered ones and those that hang, as those around them.
DiffuseField with_all_values(const FoundField& found, const std::vector<std::uint8_t>& fresh) {
  std::vector<std::uint8_t> valid;
  for (std::size_t v = 0; v < fresh.size(); ++v)
    valid.push_back(fresh[v] == 0 || has_value(found.states[v]) ? 1 : 0);
  DiffuseField field = found.field;
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored}) {
    settle_hanging(found.mesh, *values);
    fill_vertices(found.mesh, valid, *values);
    settle_hanging(found.mesh, *values);
  }
  return field;
}

} // namespace

void divide_at_shadows(const LightScene& light, const VertexSource& source, const BendScale& scale,
                       double x, FoundField found, InterpolatedField& result) {
  constexpr std::uint32_t most_divisions = 3, first_level = 0xed9e;
  constexpr std::size_t parts_more = 3;
  const std::size_t solved = element_count(found.mesh), most = solved + most_at_shadows(solved);
  for (std::uint32_t level = 0; level < most_divisions && x > 0.0; ++level) {
    const std::size_t now = element_count(found.mesh), more = now < most ? most - now : 0;
    const auto marked =
        most_bent(found.mesh, from_source(result.field), scale, x, more / parts_more);
    if (std::ranges::find(marked, 1) == marked.end())
      return;
    const FoundField coarse = kept(std::move(found), result.field);
    found = divided(coarse, light.surfaces, marked);
    const std::vector<std::uint8_t> fresh = without_value(found);
    light_fresh(source, light.surfaces, first_level + level, coarse, fresh, found);
    result.field = with_all_values(found, fresh);
    result.mesh = found.mesh;
  }
}

} // namespace meninas
