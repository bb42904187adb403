// The emission that no closed form owns:
// what rows of the transport gather of it (see the table of light paths in ARCHITECTURE.md).
//
//   G_i = sum_j T_ij E_j  over emitters gathered as a whole  +  sum_j T^beyond_ij E_j  over the others
//
// with T^beyond what lies beyond the enumerated mirror worlds:
// deep chains, facets of curved mirrors, solids of glass behind mirrors and panes.
#pragma once

#include "radiosity/transport/form_factors.h"

namespace meninas {

/// Irradiance by row, W/m^2.
std::vector<Rgb> gathered_emission(const LightScene& light, const FormFactors& factors);

/// The same by row and lamp; empty where light is not told apart.
LightByLamp gathered_by_lamp(const LightScene& light, const FormFactors& factors);

} // namespace meninas
