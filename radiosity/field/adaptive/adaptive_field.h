// The field on a mesh of its own, fine where it has to be.
//
// The irradiance at a point is D + I:
// from the source, and gathered from the radiosities of elements,
//
//   H(x) = D(x) + sum_w tau_w sum_j F^w_xj B_j.
//
// So what is fine gathers from what is coarse, and the matrix does not grow with it (Cohen,
// Greenberg, Immel, Brock 1986). D has shadow edges and spots and takes a few shadow rays a point;
// I is smooth and takes hundreds of rays. Either is refined for itself (field_refinement.h),
// D to 4/5 of the error, I to 3/5, which makes all of it;
// on the mesh that has the cells of both their sum is exact.
//
// I is gathered twice: with a quarter of the rays from the elements as they were solved, then from
// D + I as that makes them on a mesh with the cells of both. Otherwise what stands on a floor
// and the corners of a room would be lit by the mean of a large element where they see its edge.
//
// The bound is one for noise as well. The first gathering tells how much there is; in the second,
// samples take as many rays as keep it within the bound, up to sixteen times those that are asked
// for: vertices that are few do not average out one another's noise as those of fine meshes do.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/light/direct_irradiance.h"
#include "radiosity/transport/form_factors.h"

namespace meninas {

/// `elements` by ElementId of light.mesh.
InterpolatedField adaptive_field(const LightScene& light, const ElementLight& elements,
                                 const FormFactorSettings& form_factors,
                                 const DirectSettings& direct,
                                 const InterpolationSettings& settings);

} // namespace meninas
