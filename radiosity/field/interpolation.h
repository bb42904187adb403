// From element values to a continuous field of irradiance over every patch side.
//
// `average`: a vertex takes the mean of the elements around it, in its own surface;
// on the boundary of a surface the mean is extrapolated from the elements behind, never below 0.
// `gather`: the irradiance is gathered at the vertex itself, direct light by closed form,
// the rest by rays over the element radiosities (the cells of a hemicube,
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
