// Statistics of the elements' rays that shooting needs. No rows are stored, so memory is linear in the elements.
//
// The rays are those of the rows of form_factors.h.
// Where emission is gathered (ARCHITECTURE.md, path table:
// G) there are as many as rows have, and G is that of the rows; elsewhere a few suffice.
#pragma once

#include "radiosity/transport/form_factors.h"

namespace meninas {

struct HemisphereSurvey {
  std::vector<RowClosure> closure; ///< by ElementId
  std::vector<std::uint64_t>
      covered;                ///< by ElementId: the cells on which something stands (hemisphere_rays.h)
  std::vector<float> exposed; ///< by ElementId: the share of the area that is there and on which nothing stands
  std::vector<Rgb> gathered;  ///< G by ElementId, W/m^2
  std::vector<Rgb>
      returned; ///< by ElementId: sum_i F_ji (rho_i + tau_i), the share of what it shoots that is scattered where it lands
  std::vector<std::uint32_t>
      part; ///< by SideId: sides that see one another, directly or by way of others, have the same
  std::uint64_t rays_traced = 0;
};

HemisphereSurvey survey_hemispheres(const LightScene& light, const FormFactorSettings& settings,
                                    const Progress& progress = {});

/// By ElementId: sum_i F_ji (rho_i x_i + y_i) by the same rays,
/// for a worth x of the light reflected at every element, and y of what it passes on by translucent surfaces.
struct Returned {
  std::vector<Rgb> share;
  std::uint64_t rays_traced = 0;
};
Returned returned_share(const LightScene& light, const FormFactorSettings& settings,
                        const std::vector<Rgb>& worth, const std::vector<Rgb>& passed);

} // namespace meninas
