// A film as thin as the waves of light over a surface (KHR_materials_iridescence): its reflectance
// by Belcour and Barla 2017, with the first two orders of interference, as glTF's appendix has it.
//
//   R = C_0 + 2 sum_m C_m S(m D, m phi),   C_0 = R_12 + R_s,   C_m = (R_12 R_23)^(m/2) (R_s - T_121)
//   R_s = T_121^2 R_23 / (1 - R_12 R_23),   T_121 = 1 - R_12
//
// R_12 and R_23 are the reflectances of the film's faces, D = 2 n d cos(theta_2) the path that its
// second reflection has more, phi the shift of phase of both faces, and S the Fourier transform of
// the eye's sensitivities, by gaussians, in linear RGB. Without polarisation.
#pragma once

#include "scenes/types.h"

namespace meninas {

struct ThinFilm {
  double ior = 1.3;
  double thickness = 400.0; ///< nanometres
};

/// R, in [0, 1], of a film in air over what reflects `base_f0` straight on, at this cosine.
Rgb film_reflectance(const ThinFilm& film, const Rgb& base_f0, double cosine);

/// 2 integral of R(c) c dc: of light from everywhere.
Rgb mean_film_reflectance(const ThinFilm& film, const Rgb& base_f0);

/// The F0 with which Schlick's F0 + (1 - F0)(1 - c)^5 has that mean, which is (20 F0 + 1) / 21.
Rgb schlick_f0_of_mean(const Rgb& mean);

} // namespace meninas
