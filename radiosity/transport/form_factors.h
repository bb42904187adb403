// Transport between elements: the rows of Eq. 1, by rays over the hemisphere of each element.
//
// Row i of the transport is  sum_w tau_w F^w_ij  over all mirror worlds w.
// `rays`: N cosine-distributed rays from low-discrepancy points spread
// over element i (Malley's method): F_ij = (rays that land on j) / N.
// `hemicube`: one hemicube at the centre of element i,
// F_ij = sum of the delta form factors of its cells that land on j (hemicube.h);
// what is near is seen as from the centre alone (element_hemicube.h).
// A ray that meets a mirror is reflected exactly and goes on with the product of reflectances tau,
// to any depth: it ends when it lands, escapes, meets a black back,
// when tau falls below `min_throughput`, or after `max_bounces`.
// So a row closes, exactly by counts of rays, to rounding by delta form factors:
//   landed + escaped + black + cut = 1.
// Where something stands on an element (cells whose every ray meets a black back at once),
// the row speaks of the exposed rest.
// Emission is not part of the rows: light that comes straight from an emitter, or by mirrors,
// is the direct irradiance (direct_irradiance.h), and what no closed form owns (deep worlds,
// facets, large emitters) is found from the rows (gathered_emission.h).
// So form factors do not depend on what emits how much,
// nor on diffuse reflectances, and may be kept for other light (factor_file.h).
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/form_factor_rows.h"
#include "scenes/progress.h"

namespace meninas {

FormFactors assemble_transport(const LightScene& light, const FormFactorSettings& settings, const Progress& progress = {});

/// The rows of a range of elements, as a table of their own: the same bits as in the table of all.
/// Members that are by ElementId there are by row here. Precondition: not by the analytic method.
FormFactors assemble_some_rows(const LightScene& light, RowRange rows,
                               const FormFactorSettings& settings, const Progress& progress = {});

/// The same for other receivers, by rays or hemicubes:
/// what is by ElementId there is by row, columns are elements as ever.
/// The exposed share is that of the receiver's area, whatever is cut out of it.
FormFactors assemble_rows(const LightScene& light, std::size_t rows, const RowReceiver& receiver,
                          const FormFactorSettings& settings, const Progress& progress = {});

} // namespace meninas
