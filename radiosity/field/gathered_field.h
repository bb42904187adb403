// The field gathered at the vertices of the mesh that was solved,
// with finer elements where it bends.
//
//   H(x) = D(x) + sum_w tau_w sum_j F^w_xj B_j      at every vertex x
//
// direct light in closed form, indirect light by rays (point_irradiance.h).
// Facets of curved surfaces take means instead (smoothing_groups.h),
// vertices on which something stands what is gathered beside it (contact_vertices.h).
// Where the indirect part bends by more than the settings allow (interpolation_error.h),
// elements are divided and light is gathered at what vertices they get, up to three times:
// the foot of a lit wall takes a few small elements instead of small ones everywhere.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/transport/form_factors.h"

namespace meninas {

/// As interpolate(). The result has a mesh of its own where any element was divided.
InterpolatedField gathered_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings,
                                 const Progress& progress = {});

} // namespace meninas
