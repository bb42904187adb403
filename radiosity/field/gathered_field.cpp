#include "radiosity/field/gathered_field.h"

#include "radiosity/field/refine_indirect.h"
#include "radiosity/field/curves/smooth_vertices.h"
#include "radiosity/field/curves/smoothing_groups.h"


namespace meninas {

namespace {

/// At every vertex, and at those that elements get where the field bends.
void gather_at_all_vertices(const LightScene& light, const ElementLight& elements,
                       const VertexGathering& how, VertexSamples found, PointWorkspaces& workspaces,
                       InterpolatedField& result) {
  const PointGathering gathering = gathering_from(light, {elements.reflected, elements.by_lamp}, how);
  const VertexSource source{.irradiance = elements.irradiance,
                            .gathering = gathering,
                            .workspaces = workspaces,
                            .part = {how.progress, "interpolation"}};
  gather_at_vertices(source, 0, found);
  result.field = complete_field(source, found);
  refine_indirect(light, source, bend_scale(light.mesh, elements.reflected), how.interpolation.bend,
              found, result);
}

} // namespace

InterpolatedField gathered_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings, const Progress& progress) {
  PointWorkspaces workspaces;
  const VertexElements facets =
      elements.direct.empty() ? VertexElements{} : facets_around(light);
  VertexSamples found = make_samples(light, facets);
  if (!facets.elements.empty())
    average_facets(light, elements, facets, {form_factors, {}, settings.mirrored}, workspaces,
                   found.field);

  InterpolatedField result;
  gather_at_all_vertices(light, elements, {form_factors, direct, settings, progress}, std::move(found), workspaces,
                    result);
  count_rays(workspaces, result);
  return result;
}

} // namespace meninas
