// Transport between elements without sampling:
// the rows of Eq. 1 by the analytic method (`analytic`).
//
// Row i is  sum_w tau_w F^w_ij, F^w_ij the mean over the exposed part of element i of the point form factor to the
// visible parts of the image of j (point_worlds.h), integrated adaptively or in closed form (extended_form_factor.h).
// Worlds are followed until what they may bring has no weight beside the wanted accuracy,
// which is relative to the row's light, and again relative to the light of the emitters in it:
// an element's direct irradiance, sum_j F_ij E_j, is as exact as its row.
// So all emission is gathered, none sampled.
//
// The row's light ends on elements, on black faces,
// in mirrors (1 - rho of what reaches each), or outside:
//   landed + black + mirror_absorbed + escaped + cut = 1
// where `cut` bounds the worlds that were left out, and in a scene that is not
// closed `escaped` is what is left. In RowClosure all fractions are of light,
// and `landed` holds what mirrors absorb. Rows are not scaled to close.
// The work grows with the square of the elements, times worlds,
// times faces that stand between: for few of them.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/form_factor_rows.h"
#include "scenes/progress.h"

namespace meninas {

/// Throws UsageError when there are more elements than the method is for.
FormFactors analytic_transport(const LightScene& light, const FormFactorSettings& settings,
                               const Progress& progress = {});

} // namespace meninas
