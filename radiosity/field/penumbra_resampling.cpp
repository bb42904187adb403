#include "radiosity/field/penumbra_resampling.h"

#include "radiosity/field/vertex_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

namespace {

bool has_light(VertexState state) {
  return state == VertexState::direct_only || state == VertexState::low_clearance || state == VertexState::gathered;
}

/// Seen vertices of few samples in one element with one that sees an image in part.
std::vector<std::uint32_t> beside_penumbrae(const VertexSource& source,
                                            const VertexSamples& found) {
  std::vector<std::uint8_t> is_beside(found.states.size(), 0);
  for (const ElementCorners& corners : found.mesh.corners)
    if (std::ranges::any_of(corners, [&](ElementVertexId v) {
          return found.seen[index(v)] == Visibility::partial;
        }))
      for (const ElementVertexId v : corners)
        is_beside[index(v)] = 1;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < is_beside.size(); ++v)
    if (is_beside[v] != 0 && is_seen(source, v) && found.seen[v] == Visibility::uniform &&
        has_light(found.states[v]))
      vertices.push_back(v);
  return vertices;
}

} // namespace

void resample_near_penumbrae(const VertexSource& source, std::uint32_t level, VertexSamples& found) {
  VertexIrradiance& field = found.field;
  for (;;) {
    const std::vector<std::uint32_t> vertices = beside_penumbrae(source, found);
    if (vertices.empty())
      return;
    tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t k) {
      const std::uint32_t v = vertices[k];
      PointWorkspace& work = source.workspaces.local();
      const ArrivingLight light = light_beside_penumbra(
          source.gathering, found.receivers[v], vertex_seed(source, v, level), work);
      for (std::size_t l = 0; l < field.by_lamp.size(); ++l)
        field.by_lamp[l].direct[v] = glm::vec3(work.direct_by_lamp[l]);
      field.irradiance[v] = field.indirect[v] + glm::vec3(light.total);
      field.mirrored[v] = field.indirect_mirrored[v] + glm::vec3(light.mirrored);
      found.seen[v] = light.in_part ? Visibility::partial : Visibility::confirmed;
    });
  }
}

} // namespace meninas
