#include "scenes/materials/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

double squared(double x) { return x * x; }

/// Straight on, from the second to the first.
double f0_between(double of, double in) { return squared((of - in) / (of + in)); }

double schlick(double f0, double cosine) {
  return f0 + (1.0 - f0) * std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5);
}

double ior_of(double f0) {
  const double root = std::sqrt(std::clamp(f0, 0.0, 0.9999)); // none for what reflects all
  return (1.0 + root) / (1.0 - root);
}

/// exp(-v x^2) cos(p x + shift) with a gaussian's norm, x the path in metres times 2 pi.
double gaussian(double value, double place, double variance, double x, double shift) {
  return value * std::sqrt(2.0 * std::numbers::pi * variance) * std::cos(place * x + shift) *
         std::exp(-variance * x * x);
}

/// S for each channel with the shift of phase of its own.
Rgb sensitivity(double path, const Vec3& shift) {
  const double x = 2.0 * std::numbers::pi * 1e-9 * path;
  constexpr double norm = 1.0685e-7;
  const Vec3 xyz = Vec3(gaussian(5.4856e-13, 1.6810e+06, 4.3278e+09, x, shift.x) +
                            gaussian(9.7470e-14, 2.2399e+06, 4.5282e+09, x, shift.x),
                        gaussian(4.4201e-13, 1.7953e+06, 9.3046e+09, x, shift.y),
                        gaussian(5.2481e-13, 2.2084e+06, 6.6121e+09, x, shift.z)) /
                   norm;
  return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
          -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
          0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace

Rgb film_reflectance(const ThinFilm& film, const Rgb& base_f0, double at_cosine) {
  const double cosine = std::clamp(at_cosine, 0.0, 1.0);
  // A film of no thickness is none: its index of refraction fades to that of air.
  const double grown = std::clamp(film.thickness / 0.03, 0.0, 1.0);
  const double ior = std::lerp(1.0, film.ior, grown * grown * (3.0 - 2.0 * grown));
  const double sin2 = (1.0 - cosine * cosine) / (ior * ior);
  if (sin2 > 1.0)
    return Rgb(1.0);
  const double cos_film = std::sqrt(1.0 - sin2);
  const double r12 = schlick(f0_between(ior, 1.0), cosine), t121 = 1.0 - r12;
  const double phi21 = ior < 1.0 ? 0.0 : std::numbers::pi;
  Rgb r23(0.0), phi(0.0);
  for (int band = 0; band < 3; ++band) {
    const double base = ior_of(base_f0[band]);
    r23[band] = schlick(f0_between(base, ior), cos_film);
    phi[band] = phi21 + (base < ior ? std::numbers::pi : 0.0);
  }
  const Rgb r123 = glm::min(r12 * r23, 0.9999);
  const Rgb rs = t121 * t121 * r23 / (1.0 - r123);
  const double path = 2.0 * ior * film.thickness * cos_film;
  Rgb reflected = r12 + rs, order = rs - t121;
  for (int m = 1; m <= 2; ++m) {
    order *= glm::sqrt(r123);
    reflected += 2.0 * order * sensitivity(m * path, double(m) * phi);
  }
  return glm::clamp(reflected, 0.0, 1.0);
}

FilmMean mean_of_film(const ThinFilm& film, const Rgb& base_f0) {
  // Gauss and Legendre's points of x = c^2, of which the weight is even.
  constexpr std::array<double, 6> places{0.1252334085114689, 0.3678314989981802,
                                         0.5873179542866175, 0.7699026741943047,
                                         0.9041172563704749, 0.9815606342467192};
  constexpr std::array<double, 6> weights{0.2491470458134028, 0.2334925365383548,
                                          0.2031674267230659, 0.1600783285433462,
                                          0.1069393259953184, 0.0471753363865118};
  FilmMean mean;
  for (std::size_t k = 0; k < places.size(); ++k)
    for (const double x : {0.5 - 0.5 * places[k], 0.5 + 0.5 * places[k]}) {
      const Rgb at = film_reflectance(film, base_f0, std::sqrt(x));
      mean.reflectance += 0.5 * weights[k] * at;
      mean.largest += 0.5 * weights[k] * largest(at);
    }
  return mean;
}

Rgb schlick_f0_of_mean(const Rgb& mean, double f90) {
  return glm::clamp((21.0 * mean - f90) / 20.0, 0.0, 1.0);
}

} // namespace meninas
