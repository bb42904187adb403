// The light of a scene whose lamps are brighter, dimmer or of another colour, without solving again.
//
//   H = sum over lamps l of s_l H_l,     E and D of lamp l times s_l
//
// s_l is a factor by channel, dimensionless, 0 or more (scenes/lamps.h). It is exact, by linearity:
// the mesh, and what is known of each lamp, are those of all lamps together.
#pragma once

#include "radiosity/field/irradiance_field.h"

namespace meninas {

/// Makes the light of the lamps add up to the field, by vertex and channel: what rounding, and rules
/// for places without light of their own, have left of the difference is shared out in proportion.
void add_up_by_vertex(VertexIrradiance& field);

/// The field under lamps brighter by these factors, by lamp; the result is not told apart any more. Its light by
/// way of mirrors is known only if all factors are 1. Precondition: `field` is told apart by its scene's lamps.
IrradianceField relit(const IrradianceField& field, std::span<const Rgb> factors);

} // namespace meninas
