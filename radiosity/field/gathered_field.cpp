#include "radiosity/field/gathered_field.h"

#include "radiosity/field/bent_field.h"
#include "radiosity/field/facets.h"
#include "radiosity/hierarchical/node_field.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>


namespace meninas {

/// Of each facet's light from the source, and of the rest, what comes by way of mirrors:
/// in the share that a few rays find at its middle.
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

/// At every vertex, and at those that elements get where the field bends.
void gather_everywhere(const LightScene& light, const ElementLight& elements,
                       const VertexGathering& how, FoundField found, PointWorkspaces& workspaces,
                       InterpolatedField& result) {
  const PointGathering gathering = gathering_from(light, elements.reflected, how);
  const VertexSource source{elements.irradiance, gathering, workspaces};
  gather_at_vertices(source, 0, found);
  result.field = settled(source, found);
  divide_bent(light, source, bend_scale(light.mesh, elements.reflected), how.interpolation.bend,
              found, result);
}

} // namespace

InterpolatedField gathered_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings,
                                 ReceiverNodes* receivers) {
  PointWorkspaces workspaces;
  const VertexElements facets =
      elements.from_source.empty() ? VertexElements{} : facets_around(light);
  FoundField found = receivers != nullptr ? std::move(receivers->vertices)
                                          : unknown_field(light.mesh, facets);
  if (!facets.elements.empty())
    average_facets(light, elements, facets, form_factors, workspaces, found.field);

  InterpolatedField result;
  if (receivers != nullptr)
    result = field_by_nodes(light, elements, *receivers, {form_factors, direct, settings},
                            std::move(found), workspaces);
  else
    gather_everywhere(light, elements, {form_factors, direct, settings}, std::move(found),
                      workspaces, result);
  for (const auto& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
  return result;
}

} // namespace meninas
