// Vertices of finely tessellated curves take the mean of what the facets around them have received.
//
//   H_v = sum_e A_e H_e / sum_e A_e     over the facets e of the smoothing group around v (smoothing_groups.h)
//
// Direct and indirect light are averaged apart. Their parts that come by way of mirrors are the
// shares that a few rays find at the middle of each facet.
#pragma once

#include "radiosity/field/vertex_gathering.h"

namespace meninas {

struct FacetAverages {
  const FormFactorSettings& form_factors;
  bool mirrored = true; ///< InterpolationSettings::mirrored; else those parts stay 0
};

/// Sets the values of all vertices that `facets` has elements for.
void average_facets(const LightScene& light, const ElementLight& elements,
                    const VertexElements& facets, const FacetAverages& how,
                    PointWorkspaces& workspaces, VertexIrradiance& field);

} // namespace meninas
