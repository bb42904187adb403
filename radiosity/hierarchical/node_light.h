// Direct light where elements only light others and vertices are seen:
//
//   D_j = mean of D over element j, as its corners and second differences tell (curved_means.h)
//
// Elements get samples of their own (element_light.h) if
//   (a) they are partly covered (contact_mask.h) or are facets of a curve (smoothing_groups.h),
//   (b) their group, a 512th of all elements, receives or reflects over 1/256 of the total,
//   (c) the mesh has at most 512 elements.
#pragma once

#include "radiosity/light/element_light.h"
#include "radiosity/field/final_gathering.h"
#include "radiosity/transport/substructuring.h"

namespace meninas {

/// Vertices with direct light alone, also that of punctual lights by itself,
/// and the rays that took. Vertices that take the means of facets have no value yet.
struct LitVertices {
  VertexSamples found;
  std::uint64_t rays = 0, shadow_rays = 0;
};
LitVertices lit_vertices(const LightScene& light, const VertexGathering& how);

/// By ElementId. `covered` likewise: on what something stands.
DirectIrradiance light_by_corners(const LightScene& light, const NodeTree& tree,
                                  std::span<const ContactMask> covered, const VertexSamples& vertices,
                                  const DirectSettings& settings, const Progress& progress);

/// Light of some elements anew, each by its own points.
void recompute_direct(const LightScene& light, std::span<const ElementId> elements,
                 std::span<const ContactMask> covered, const DirectSettings& settings,
                 const Progress& progress, DirectIrradiance& direct);

/// The mean of the squares of light over the square of its mean (1 where it is even), by ElementId;
/// in the brightest channel, weighed by areas, m^2.
double unevenness(const std::vector<double>& areas, const std::vector<Rgb>& values);

} // namespace meninas
