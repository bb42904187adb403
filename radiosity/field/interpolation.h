// From element values to a continuous field of irradiance over every patch side.
//
// `average` (Cohen, Greenberg 1985): a vertex takes the mean of the n elements around it, in its own surface;
// on the boundary of a surface the mean is extrapolated from the elements behind, never below 0:
//
//   M_v = 1/n sum_e H_e,   H_v = max(0, M_v + min(1, a / b) (M_v - M_u))      (boundary)
//
// a is the distance from v to the middle of its elements, b how much further in the middle of those around the
// inner neighbour u is.
// `gather`: the irradiance is gathered at the vertex itself, direct light by closed form,
// indirect light by rays over the element radiosities (the cells of a hemicube,
// where form factors are found so): the field is right at its vertices.
// Vertices of curved surfaces, whose facets are smaller than half an element,
// take the mean of the facets around instead (smoothing_groups.h).
// Vertices that see nothing but the black insides of things that stand on
// them hold no value of their own (contact_vertices.h, vertex_fill.h).
// Between vertices the field is bilinear in quads, linear in triangles.
// It is irradiance, W/m^2: reflectance is applied at the hit.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/transport/form_factors.h"

namespace meninas {

InterpolatedField interpolate(const LightScene& light, const ElementLight& elements,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const InterpolationSettings& settings,
                              const Progress& progress = {});

} // namespace meninas
