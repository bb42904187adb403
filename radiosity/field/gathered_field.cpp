#include "radiosity/field/gathered_field.h"

#include "radiosity/field/bent_field.h"
#include "radiosity/field/facet_means.h"
#include "radiosity/field/facets.h"


namespace meninas {

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
                                 const InterpolationSettings& settings) {
  PointWorkspaces workspaces;
  const VertexElements facets =
      elements.from_source.empty() ? VertexElements{} : facets_around(light);
  FoundField found = unknown_field(light.mesh, facets);
  if (!facets.elements.empty())
    average_facets(light, elements, facets, form_factors, workspaces, found.field);

  InterpolatedField result;
  gather_everywhere(light, elements, {form_factors, direct, settings}, std::move(found), workspaces,
                    result);
  count_rays(workspaces, result);
  return result;
}

} // namespace meninas
