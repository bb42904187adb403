#include "radiosity/gathered_field.h"

#include "radiosity/bends.h"
#include "radiosity/contact_vertices.h"
#include "radiosity/facets.h"
#include "radiosity/gap_vertices.h"
#include "radiosity/mesh_division.h"
#include "radiosity/vertex_fill.h"
#include "radiosity/vertex_light.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace meninas {

using PointWorkspaces = tbb::enumerable_thread_specific<PointWorkspace>;

/// Vertices that do not gather take what the corners of their receiver have gathered, as far as these are not covered.
static void share_indirect(const VertexShares& shares, std::vector<std::uint8_t>& valid,
                           DiffuseField& field) {
  for (std::size_t v = 0; v < valid.size(); ++v) {
    if (gathers(shares, v))
      continue;
    glm::vec3 total(0.0F), mirrored(0.0F);
    float weights = 0.0F;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t from = index(shares.from[v][c]);
      const float weight = valid[from] != 0 ? shares.weight[v][c] : 0.0F;
      total += weight * field.indirect[from];
      mirrored += weight * field.indirect_mirrored[from];
      weights += weight;
    }
    if (!(weights > 0.0F)) {
      valid[v] = 0;
      continue;
    }
    field.indirect[v] = total / weights;
    field.indirect_mirrored[v] = mirrored / weights;
    field.irradiance[v] += field.indirect[v];
    field.mirrored[v] += field.indirect_mirrored[v];
  }
}

/// Of each facet's light from the source, and of the rest, what comes by way of mirrors: in the share that a few rays find at its middle.
static std::array<std::vector<Rgb>, 2> mirrored_parts(const LightScene& light,
                                                      const std::vector<std::uint8_t>& averaged,
                                                      const std::array<std::vector<Rgb>, 2>& parts,
                                                      const PointGathering& gathering,
                                                      PointWorkspaces& workspaces) {
  const ElementMesh& mesh = light.mesh;
  std::array<std::vector<Rgb>, 2> mirrored;
  for (auto& part : mirrored)
    part.assign(element_count(mesh), Rgb(0.0));
  const auto share = [](const ArrivingLight& arrived) {
    return glm::clamp(arrived.mirrored / glm::max(arrived.total, Rgb(1e-300)), 0.0, 1.0);
  };
  tbb::parallel_for(std::size_t{0}, element_count(mesh), [&](std::size_t e) {
    if (averaged[e] == 0)
      return;
    const MeshSide& side = mesh.sides[index(mesh.side_of_element[e])];
    const Receiver middle{centre_of(mesh, static_cast<ElementId>(e)), side.normal, side.plane_class,
                          side.tangent, side.coat};
    const PointLight found = light_at(
        gathering, middle, hash(static_cast<std::uint32_t>(e), 0xface7), workspaces.local());
    mirrored[0][e] = share(found.from_source) * parts[0][e];
    mirrored[1][e] = share(found.indirect()) * parts[1][e];
  });
  return mirrored;
}

/// Vertices of facets take the means of what these have received.
static void average_facets(const LightScene& light, const ElementLight& elements,
                           const VertexElements& facets, const FormFactorSettings& form_factors,
                           PointWorkspaces& workspaces, DiffuseField& field) {
  constexpr int few_rays = 16;
  const ElementMesh& mesh = light.mesh;
  std::array<std::vector<Rgb>, 2> parts{elements.from_source, elements.irradiance}, mirrored;
  for (std::size_t e = 0; e < element_count(mesh); ++e)
    parts[1][e] -= parts[0][e];
  if (!light.mirrors.mirrors.empty() || light.mirrors.facets > 0) {
    const PointGathering gathering(light, elements.reflected, form_factors,
                                   {.shadow_rays = 4, .penumbra_rays = 4},
                                   {.rays = few_rays, .cluster_shadow_rays = 1});
    mirrored = mirrored_parts(light, averaged_facets(mesh, facets), parts, gathering, workspaces);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto own = around(facets, v);
    if (own.empty())
      continue;
    const auto mean = [&](const std::vector<Rgb>& values) {
      return values.empty() ? glm::vec3(0.0F) : facet_mean(mesh, own, elements.irradiance, values);
    };
    field.indirect[v] = mean(parts[1]);
    field.irradiance[v] = field.indirect[v] + mean(parts[0]);
    field.indirect_mirrored[v] = mean(mirrored[1]);
    field.mirrored[v] = field.indirect_mirrored[v] + mean(mirrored[0]);
  }
}

namespace {

/// What a vertex has.
enum class VertexState : std::uint8_t { unknown, covered, averaged, gathered };

/// A mesh with the values of vertices as they were found, before contacts are settled; hanging vertices may be unknown.
struct FoundField {
  ElementMesh mesh;
  DiffuseField field;
  std::vector<VertexState> states; ///< by ElementVertexId
};

/// What vertices gather from.
struct VertexSource {
  const ElementLight& elements;
  const PointGathering& gathering;
  const VertexShares* shares;
  PointWorkspaces& workspaces;
};

template <typename Change>
void for_each_array(DiffuseField& field, const Change& change) {
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored})
    change(*values);
}

FoundField unknown_field(ElementMesh mesh) {
  FoundField found{std::move(mesh), {}, {}};
  const std::size_t count = found.mesh.vertices.size();
  found.states.assign(count, VertexState::unknown);
  for_each_array(found.field, [&](auto& values) { values.assign(count, glm::vec3(0.0F)); });
  return found;
}

/// Gathers at the vertices that are unknown and do not hang. `level` tells apart the samples of vertices whose numbers are the same.
void gather_at_vertices(const VertexSource& source, std::uint32_t level, FoundField& found) {
  constexpr std::size_t chunk_size = 64;
  const ElementMesh& mesh = found.mesh;
  const PointGathering& gathering = source.gathering;
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  std::vector<std::uint8_t> hangs(mesh.vertices.size(), 0);
  for (const HangingVertex& hanging : mesh.hanging)
    hangs[index(hanging.vertex)] = 1;
  const auto light_vertex = [&](std::size_t v, PointWorkspace& work) {
    if (found.states[v] != VertexState::unknown || hangs[v] != 0)
      return;
    const double size = size_of(mesh, mesh.element_of_vertex[v]);
    const std::uint32_t seed =
        hash(static_cast<std::uint32_t>(v), gathering.form_factors.seed, 0x7e27 + level);
    const VertexValue value =
        source.shares == nullptr || gathers(*source.shares, v)
            ? value_at(gathering, source.elements.irradiance, receivers[v], size, seed, work)
            : value_from_source(gathering, receivers[v], size, seed, work);
    found.field.irradiance[v] = glm::vec3(value.irradiance.total);
    found.field.mirrored[v] = glm::vec3(value.irradiance.mirrored);
    found.field.indirect[v] = glm::vec3(value.indirect.total);
    found.field.indirect_mirrored[v] = glm::vec3(value.indirect.mirrored);
    found.states[v] = value.covered ? VertexState::covered : VertexState::gathered;
  };
  tbb::parallel_for(std::size_t{0}, (mesh.vertices.size() + chunk_size - 1) / chunk_size,
                    [&](std::size_t c) {
                      PointWorkspace& work = source.workspaces.local();
                      for (std::size_t v = c * chunk_size;
                           v < std::min(mesh.vertices.size(), (c + 1) * chunk_size); ++v)
                        light_vertex(v, work);
                    });
}

/// Vertices on which something stands, or at whose side it does, take what is gathered beside it; those of facets keep their means.
void light_contacts(const VertexSource& source, const FoundField& found,
                    std::vector<std::uint8_t>& valid, DiffuseField& field) {
  const ElementMesh& mesh = found.mesh;
  const PointGathering& gathering = source.gathering;
  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  std::vector<std::uint8_t> open = valid;
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t v) {
    if (open[v] != 0 && found.states[v] != VertexState::averaged &&
        is_at_foot(gathering.light, receivers[v]))
      open[v] = 0;
  });
  const std::vector<ContactEdge> edges = contact_edges(mesh, open);
  std::vector<ContactLight> lights(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t k) {
    const auto [covered, exposed] = edges[k];
    lights[k] = light_at_contact(
        gathering, source.elements.irradiance, receivers[exposed], receivers[covered].position,
        size_of(mesh, mesh.element_of_vertex[exposed]),
        hash(covered, exposed, gathering.form_factors.seed), source.workspaces.local());
  });
  extend_to_contacts(edges, lights, valid, field);
}

/// The corners of elements that are open only in between take what is gathered there.
void light_gaps(const VertexSource& source, const ElementMesh& mesh,
                std::vector<std::uint8_t>& valid, DiffuseField& field) {
  const std::vector<ElementId> covered = covered_elements(mesh, valid);
  std::vector<std::optional<GapLight>> lights(covered.size());
  tbb::parallel_for(std::size_t{0}, covered.size(), [&](std::size_t k) {
    lights[k] = light_in_gap(source.gathering, source.elements.irradiance, mesh, covered[k],
                             source.workspaces.local());
  });
  take_from_gaps(mesh, covered, lights, valid, field);
}

/// The field with values at all vertices.
DiffuseField settled(const VertexSource& source, const FoundField& found) {
  DiffuseField field = found.field;
  std::vector<std::uint8_t> valid;
  for (const VertexState state : found.states)
    valid.push_back(state == VertexState::averaged || state == VertexState::gathered ? 1 : 0);
  if (source.shares != nullptr)
    share_indirect(*source.shares, valid, field);
  for_each_array(field, [&](auto& values) { settle_hanging(found.mesh, values); });
  light_contacts(source, found, valid, field);
  light_gaps(source, found.mesh, valid, field);
  for_each_array(field, [&](auto& values) {
    fill_vertices(found.mesh, valid, values);
    settle_hanging(found.mesh, values);
  });
  return field;
}

/// The marked elements divided; what was found is kept.
FoundField divided(const FoundField& before, const SurfaceModel& surfaces,
                   std::span<const std::uint8_t> marked) {
  FoundField after = unknown_field(divide_elements(before.mesh, surfaces, marked));
  const std::vector<CellId> now = same_cells(before.mesh, after.mesh);
  for (std::size_t e = 0; e < element_count(before.mesh); ++e) {
    const ElementCorners corners =
        corners_of(after.mesh, now[index(before.mesh.cell_of_element[e])]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const std::uint32_t from = index(before.mesh.corners[e][c]), to = index(corners[c]);
      after.states[to] = before.states[from];
      after.field.irradiance[to] = before.field.irradiance[from];
      after.field.mirrored[to] = before.field.mirrored[from];
      after.field.indirect[to] = before.field.indirect[from];
      after.field.indirect_mirrored[to] = before.field.indirect_mirrored[from];
    }
  }
  return after;
}

} // namespace

InterpolatedField gathered_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings,
                                 const VertexShares* shares) {
  constexpr std::uint32_t most_divisions = 3;
  const PointGathering gathering(
      light, elements.reflected, form_factors, direct,
      {.rays = settings.rays, .cluster_shadow_rays = settings.cluster_shadow_rays});
  PointWorkspaces workspaces;
  const VertexSource source{elements, gathering, shares, workspaces};

  FoundField found = unknown_field(light.mesh);
  const VertexElements facets =
      elements.from_source.empty() ? VertexElements{} : facets_around(light);
  if (!facets.elements.empty())
    average_facets(light, elements, facets, form_factors, workspaces, found.field);
  for (std::size_t v = 0; v < found.states.size(); ++v)
    if (is_averaged(facets, v))
      found.states[v] = VertexState::averaged;
  gather_at_vertices(source, 0, found);

  InterpolatedField result{.field = settled(source, found)};
  const double bend = shares == nullptr ? settings.bend : 0.0;
  const BendScale scale = bend_scale(light.mesh, elements.reflected);
  for (std::uint32_t level = 1; level <= most_divisions && bend > 0.0; ++level) {
    const auto marked = bent_elements(found.mesh, result.field.indirect, scale, bend);
    if (std::ranges::find(marked, 1) == marked.end())
      break;
    found = divided(found, light.surfaces, marked);
    gather_at_vertices(source, level, found);
    result.field = settled(source, found);
    result.mesh = found.mesh;
  }
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  return result;
}

} // namespace meninas
