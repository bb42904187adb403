// Light from the source where elements only light others and vertices are seen:
//
//   D_j = mean of D over element j, as its corners and second differences tell (curved_means.h)
//
// Vertices have it anyway, and what such elements light takes the mean over many of them.
// Elements whose corners do not tell have points of their own (element_light.h):
// those of which something covers a part or a corner (contact_mask.h),
// and facets of curved surfaces, whose means are seen (smoothing_groups.h).
// So have groups of elements, a 512th of all, at which more than a 256th of all light arrives,
// or that reflect as much of what is: a spot of the sun is some tens of elements,
// and all light comes from there, and a black shade around a lamp absorbs more
// than corners of its elements tell. And so has a mesh of no more elements than that.
#pragma once

#include "radiosity/light/element_light.h"
#include "radiosity/field/vertex_gathering.h"
#include "radiosity/transport/element_hierarchy.h"

namespace meninas {

/// Vertices with light from the source alone, also that of punctual lights by itself,
/// and the rays that took. What takes the means of facets has no value yet.
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

} // namespace meninas
