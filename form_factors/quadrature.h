// Adaptive Gauss-Kronrod integration (7, 15 points;
// Piessens et al. 1983, QUADPACK), with its error estimate.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {

/// A number with an estimate of its absolute error.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

inline Estimate operator+(const Estimate& a, const Estimate& b) {
  return {a.value + b.value, a.error + b.error};
}
inline Estimate operator*(double s, const Estimate& a) {
  return {s * a.value, std::abs(s) * a.error};
}

namespace quadrature {

inline constexpr std::array<double, 8> kronrod_nodes{
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
inline constexpr std::array<double, 8> kronrod_weights{
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
inline constexpr std::array<double, 4> gauss_weights{
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

} // namespace quadrature

/// One Kronrod rule over [a, b],
/// with QUADPACK's estimate from the difference to the embedded Gauss rule.
struct KronrodResult {
  Estimate integral;
  double rounding = 0.0; ///< below this the error cannot fall: the rounding of int |f|
};

template <typename Function>
KronrodResult kronrod(const Function& f, double a, double b) {
  using namespace quadrature;
  const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
  const double middle = f(centre);
  double by_kronrod = kronrod_weights[7] * middle, by_gauss = gauss_weights[3] * middle,
         magnitude = kronrod_weights[7] * std::abs(middle);
  for (std::size_t k = 0; k < 7; ++k) {
    const double low = f(centre - half * kronrod_nodes[k]),
                 high = f(centre + half * kronrod_nodes[k]);
    by_kronrod += kronrod_weights[k] * (low + high);
    magnitude += kronrod_weights[k] * (std::abs(low) + std::abs(high));
    if (k % 2 == 1)
      by_gauss += gauss_weights[k / 2] * (low + high);
  }
  magnitude *= std::abs(half);
  const double difference = std::abs((by_kronrod - by_gauss) * half);
  const double error =
      magnitude > 0.0
          ? std::min(magnitude * std::pow(200.0 * difference / magnitude, 1.5), 200.0 * difference)
          : 0.0;
  const double rounding = 1e-15 * magnitude;
  return {{by_kronrod * half, std::max(error, rounding)}, rounding};
}

/// Bisects until the error of every part is within `tolerance` or the rounding of the integrand,
/// at most `depth` times.
template <typename Function>
Estimate integrate(const Function& f, double a, double b, double tolerance, int depth = 40) {
  const auto [whole, rounding] = kronrod(f, a, b);
  if (whole.error <= std::max(tolerance, 4.0 * rounding) || depth == 0)
    return whole;
  const double middle = 0.5 * (a + b);
  return integrate(f, a, middle, tolerance, depth - 1) +
         integrate(f, middle, b, tolerance, depth - 1);
}

} // namespace meninas
