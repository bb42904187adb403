// How the irradiance field is found from the solution of pass one, and how exactly.
#pragma once

#include <cstddef>
#include <optional>

namespace meninas {

enum class Interpolation { average, gather };

struct AdaptiveSettings {
  double error =
      0.02; ///< wanted of the interpolated radiosity, relative, in the mean square (field_refinement.h)
  std::size_t max_elements = 1'000'000;
};

struct InterpolationSettings {
  Interpolation method = Interpolation::gather;
  int rays = 512; ///< per vertex, for `gather`
  int cluster_shadow_rays =
      8; ///< per bright cluster (secondary_emitters.h) and vertex, where it matters most
  double bend =
      0.0; ///< X: elements in which indirect light bends by more are divided (gathered_field.h); 0: none
  double shadow_bend =
      0.0; ///< likewise of direct light, by nodes (refine_direct.h); 0: none
  std::optional<AdaptiveSettings> adaptive =
      {}; ///< `gather` on a mesh of its own (adaptive_field.h)
};

} // namespace meninas
