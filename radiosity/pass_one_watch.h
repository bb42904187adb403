// Intermediate states of pass one, while light is still being shot or gathered sweep by sweep: the field so
// far, for pictures along the way. Irradiance in W/m^2.
#pragma once

#include "radiosity/field/irradiance_field.h"

#include <functional>

namespace meninas {

/// The light of the shots, or sweeps, so far, as averages over elements at the vertices of the mesh that is
/// solved (field/interpolation.h), and the ambient term of the light yet to be shot.
struct PassOneSoFar {
  int shots = 0; ///< of `jacobi` sweeps
  VertexIrradiance field;
  Rgb ambient{0.0}; ///< irradiance, everywhere
  double unshot = 0.0; ///< the power that is left to shoot, in that of the first light, luminance
};
struct PassOneWatch {
  int every = 0; ///< shots, and after the last; 0: never
  std::function<void(const PassOneSoFar&)> look;
  bool before_shots = false; ///< what the first light alone brings, too
};

} // namespace meninas
