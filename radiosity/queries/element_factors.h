// The row of Eq. 1 of one element, told apart by whether light has been reflected by a mirror on its way:
//
//   F_ij = sum over worlds w of tau_w F^w_ij = F^0_ij + sum over w > 0 of tau_w F^w_ij,      mean of the channels
//
// Both come from the assembler of pass one (transport/form_factors.h), by the same rays: once as ever, and once with
// chains that end at the first reflection. Light that passes panes and solids of glass unreflected counts as direct.
// Where nothing escapes and mirrors absorb nothing  sum_j F_ij = 1,  since no element sees itself.
#pragma once

#include "radiosity/transport/form_factors.h"

#include <vector>

namespace meninas {

struct ElementFactor {
  ElementId to = none<ElementId>;
  double direct = 0.0, mirrored = 0.0;
};

struct ElementFactors {
  std::vector<ElementFactor> row; ///< those that are not 0
  RowClosure closure;
};

/// By rays or hemicubes, as the settings say; by rays where they say `analytic`.
ElementFactors element_factors(const LightScene& light, ElementId element, FormFactorSettings settings);

} // namespace meninas
