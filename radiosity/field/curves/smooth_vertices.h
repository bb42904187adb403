// Vertices of finely tessellated curves take the mean of what the facets around them have received.
//
//   H_v = sum_e A_e H_e / sum_e A_e     over the facets e of the smoothing group around v (smoothing_groups.h)
//
// Direct and indirect light are averaged apart. Their parts that come by way of mirrors are the
// shares that a few rays find at the middle of each facet.
// Facets that received indirect light as a cluster (transport/face_clusters.h) all have its mean, which should change
// as smoothly as the curve does: such facets take the mean of their vertices, and these that of their facets, ring
// after ring, as far as a cluster extends.
#pragma once

#include "radiosity/field/final_gathering.h"

namespace meninas {

struct FacetAverages {
  const FormFactorSettings& form_factors;
  std::span<const std::uint8_t> clustered; ///< by ElementId, 1: its indirect light is that of a cluster; empty: of none
  bool mirrored = true; ///< InterpolationSettings::mirrored; else those parts stay 0
};

/// Sets the values of all vertices that `facets` has elements for.
void average_facets(const LightScene& light, const ElementLight& elements,
                    const VertexElements& facets, const FacetAverages& how,
                    PointWorkspaces& workspaces, VertexIrradiance& field);

} // namespace meninas
