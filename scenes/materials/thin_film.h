// A film as thin as the waves of light over a surface (KHR_materials_iridescence): its reflectance
// by Belcour and Barla 2017, with the first two orders of interference, as glTF's appendix has it.
//
//   R = C_0 + 2 sum_m C_m S(m D, m phi),   C_0 = R_12 + R_s,   C_m = (R_12 R_23)^(m/2) (R_s - T_121)
//   R_s = T_121^2 R_23 / (1 - R_12 R_23),   T_121 = 1 - R_12
//
// R_12 and R_23 are the reflectances of the film's faces, D = 2 n d cos(theta_2) the path that its
// second reflection has more, phi the shift of phase of both faces, and S the Fourier transform of
// the eye's sensitivities, by gaussians, in linear RGB. Without polarisation.
//
// A share s of a surface that lies below it reflects (1 - s) R_base(c) + s R(c) at a facet that is
// met at cosine c: R_base is the colour of metal, or Schlick's or Fresnel's reflectance of what is
// none. Pass two has it by the angle. In pass one coats that are mirrors and glass have it by the angle
// as well; metals that are mirrors, and all that is spread evenly, have the mean.
#pragma once

#include "scenes/types.h"

namespace meninas {

struct ThinFilm {
  double ior = 1.3;
  double thickness = 400.0; ///< nanometres
  double share = 0.0;       ///< s, in [0, 1]; 0: there is no film

  bool operator==(const ThinFilm&) const = default;
};

/// R, in [0, 1], of a film in air over what reflects `base_f0` straight on, at this cosine.
Rgb film_reflectance(const ThinFilm& film, const Rgb& base_f0, double cosine);

/// 2 integral of R(c) c dc, of light from everywhere, and likewise of its largest channel; to 2e-3.
struct FilmMean {
  Rgb reflectance{0.0};
  double largest = 0.0;
};
FilmMean mean_of_film(const ThinFilm& film, const Rgb& base_f0);

/// (1 - s) base + s film.
inline Rgb below_film(const ThinFilm& film, const Rgb& of_base, const Rgb& of_film) {
  return glm::mix(of_base, of_film, film.share);
}

/// The F0 with which Schlick's F0 + (F90 - F0)(1 - c)^5 has that mean, which is (20 F0 + F90) / 21.
Rgb schlick_f0_of_mean(const Rgb& mean, double f90 = 1.0);

} // namespace meninas
