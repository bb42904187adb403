// The method and accuracy by which the irradiance field follows from the solution of pass one.
#pragma once

namespace meninas {

enum class Interpolation { average, gather };

struct InterpolationSettings {
  Interpolation method = Interpolation::gather;
  int rays = 512; ///< per vertex, for `gather`
  int cluster_shadow_rays =
      8; ///< per secondary emitter (secondary_emitters.h) and vertex, where it matters most
  double bend =
      0.0; ///< X: elements in which indirect light bends by more are divided (gathered_field.h); 0: none
  double shadow_bend =
      0.0; ///< likewise of direct light, by nodes (refine_direct.h); 0: none
  /// Whether the field tells what came by way of mirrors, as layers and stored solutions want it:
  /// facets of curves send rays for that alone.
  bool mirrored = true;
};

} // namespace meninas
