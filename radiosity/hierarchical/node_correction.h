// What the solution by receivers has lost or made up, found from the field and sent on.
//
// Receivers gather by few rays and send as if all of one received the same. Both leave some per mille of the light
// of a bounce, alike everywhere, and reflections add up to several times as much. The field gathers by many rays,
// from elements that differ. It is a better transport K of the same light, of which receivers have the coarse one T:
//
//   I_1 = what elements sent by, I_2 = K rho (D + I_1) what vertices find of that,    d = I_2 - I_1
//   I = I_2 + T x,    x = rho d + rho T x                              W/m^2
//
// so that I is right as far as K is: iterated defect correction, with two grids (Brakhage 1960, Atkinson 1976,
// K. Atkinson, The Numerical Solution of Integral Equations of the Second Kind, 1997, chapter 6).
// d is small and smooth but for noise, which T averages; x takes one more solution of the receivers' system.
// Where rows close and light is even everywhere, d = 0.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/hierarchical/receiver_nodes.h"

namespace meninas {

/// T x by ElementId, W/m^2. `missed` is d, by ElementId.
std::vector<Rgb> further_reflected(const ReceiverSystem& system, const std::vector<Rgb>& missed);

/// Adds that to light that is known besides: at most half of it, taken or given.
void add_reflected(const std::vector<Rgb>& more, std::vector<Rgb>& received);

/// The same at vertices, each by the mean of its elements; of the indirect part mirrors have their share of it.
void add_reflected(const ReceiverSystem& system, const VertexSamples& found,
                   const std::vector<Rgb>& more, VertexIrradiance& field);

} // namespace meninas
