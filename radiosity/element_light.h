// Direct irradiance of elements: the mean over an element of what emitters and their images send (direct_irradiance.h).
//
//   D_i = 1/A_i integral over element i of D(x)  ~  sum_w tau_w sum_e E_e  mean_p F(x_p, T_w e clipped)  sum_pk g_pk V_pk / sum_pk g_pk
//
// Points x_p are a low-discrepancy sequence over the element, and so are the points on each image that shadow rays go to, counted on
// from point to point: a ray or two from each do what many would from a few. g is the share of the form factor a ray stands for, so that
// a fully visible image comes out as the closed form's mean, without noise. Points are doubled until the mean settles.
#pragma once

#include "radiosity/direct_irradiance.h"

namespace meninas {

struct DirectIrradiance {
  std::vector<Rgb> irradiance; ///< by ElementId, the mean over the element
  std::vector<Rgb>
      punctual; ///< the part of it that punctual lights sent; empty where there are none
  std::uint64_t shadow_rays = 0;
};

/// `covered` by ElementId (gather_rays.h): the mean is over the exposed part. Empty: all is exposed.
DirectIrradiance direct_irradiance(const LightScene& light, std::span<const std::uint64_t> covered,
                                   const DirectSettings& settings, const Progress& progress = {});

} // namespace meninas
