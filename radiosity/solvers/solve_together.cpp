#include "radiosity/solvers/solve_together.h"

#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/solvers.h"

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

using Columns = Eigen::Array<double, 1, Eigen::Dynamic>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Matrix matrix_of(const LightByLamp& light) {
  return Eigen::Map<const Matrix>(light.values.data(), static_cast<Eigen::Index>(light.rows),
                                  static_cast<Eigen::Index>(light.columns));
}

LightByLamp light_of(const Matrix& matrix) {
  return {.rows = static_cast<std::size_t>(matrix.rows()),
          .columns = static_cast<std::size_t>(matrix.cols()),
          .values = {matrix.data(), matrix.data() + matrix.size()}};
}

/// The values of every channel of every lamp, by column.
Columns by_column(const Rgb& channels, Eigen::Index columns) {
  Columns values(columns);
  for (Eigen::Index c = 0; c < columns; ++c)
    values(c) = channels[static_cast<int>(c % 3)];
  return values;
}

/// The system of all lamps.
struct SystemOfLamps {
  const Transport& transport;
  Matrix reflectance; ///< of one lamp
  Matrix source;
};

/// rho T x
Matrix reflected(const SystemOfLamps& system, const Matrix& x) {
  Matrix light = matrix_of(transport_product(system.transport, light_of(x)));
  for (Eigen::Index row = 0; row < light.rows(); ++row)
    for (Eigen::Index c = 0; c < light.cols(); ++c)
      light(row, c) *= system.reflectance(row, c % 3);
  return light;
}

Columns norms(const Matrix& x) {
  return x.rows() > 0 ? Columns(x.cwiseAbs().colwise().maxCoeff().array())
                      : Columns(Columns::Zero(x.cols()));
}

Columns products(const Matrix& a, const Matrix& b) {
  return a.cwiseProduct(b).colwise().sum().array();
}

/// a / b, 0 where that is no number.
Columns quotients(const Columns& a, const Columns& b) {
  return (b.abs() >= std::numeric_limits<double>::min()).select(a / b, 0.0);
}

void add(Matrix& a, const Columns& factor, const Matrix& b) {
  a += (b.array().rowwise() * factor).matrix();
}

/// The stopping rule by column: 1 for columns further from their solution than asked, 0 for others.
struct Goal {
  Columns amplification;
  double tolerance;

  Columns missed(const Matrix& residual, const Matrix& x) const {
    const Columns left = norms(residual), size = norms(x);
    // Without a bound what is left is measured by itself; rounding is as far as it goes.
    const Columns weight = amplification.isFinite().select(amplification, 1.0);
    constexpr double rounding = 1e-14;
    return (left * weight > tolerance * size && left > rounding * size).cast<double>();
  }
};

/// One run of BiCGStab (krylov.cpp); returns how many steps it took.
int run(const SystemOfLamps& system, const Goal& goal, int most, Matrix& x) {
  Matrix r = system.source - x + reflected(system, x);
  const Matrix shadow = r;
  Matrix p = r;
  Columns rho = products(shadow, r), active = goal.missed(r, x);
  int steps = 0;
  for (; steps < most && (active != 0.0).any(); ++steps) {
    // Along p as far as makes the residual orthogonal to the shadow, ...
    const Matrix v = p - reflected(system, p);
    const Columns alpha = active * quotients(rho, products(shadow, v));
    add(x, alpha, p);
    add(r, -alpha, v);

    // ... and along what is left of the residual as far as makes it shortest.
    const Matrix t = r - reflected(system, r);
    const Columns omega = active * quotients(products(t, r), products(t, t));
    add(x, omega, r);
    add(r, -omega, t);
    active *= goal.missed(r, x);

    // The next direction is conjugate to this one; a column without one has broken down.
    const Columns next = products(shadow, r);
    const Columns beta = quotients(next, rho) * quotients(alpha, omega);
    active = (beta == 0.0).select(0.0, active);
    add(p, -omega, v);
    p = r + (p.array().rowwise() * beta).matrix();
    rho = next;
  }
  return steps;
}

} // namespace

LightByLamp scattered(const Scattering& scattering, const LightByLamp& irradiance) {
  LightByLamp sent{.rows = irradiance.rows, .columns = irradiance.columns};
  for (std::size_t l = 0; l < irradiance.columns / 3; ++l)
    set_light_of_lamp(sent, l,
                      scattered(scattering.reflectance, scattering.translucent,
                                light_of_lamp(irradiance, l)));
  return sent;
}

LightByLamp solve_together(const Transport& transport, const LightByLamp& sources,
                           const Scattering& scattering, const SolverSettings& settings) {
  if (!scattering.translucent.empty()) {
    const MixedRows mixed = mixed_rows(transport, scattering.reflectance, scattering.translucent);
    return solve_together(mixed.transport, sources, {mixed.total, {}}, settings);
  }
  std::vector<Rgb> all(scattering.reflectance.size(), Rgb(0.0));
  for (std::size_t l = 0; l < sources.columns / 3; ++l) {
    const std::vector<Rgb> own = light_of_lamp(sources, l);
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] += own[i];
  }
  const LinearSystem<Rgb> whole{transport, all, scattering.reflectance};
  const LinearSystem<Rgb> together = without_traps(whole, open_rows(whole));
  LightByLamp reflectance = no_light(all.size(), 1);
  set_light_of_lamp(reflectance, 0, together.reflectance);
  const SystemOfLamps system{transport, matrix_of(reflectance), matrix_of(sources)};
  const Rgb amplification =
      amplification_bound(together, settings.max_iterations);
  const Goal goal{by_column(amplification, system.source.cols()), settings.tolerance};

  // A run whose recurrences have drifted is begun anew, from where it is.
  Matrix x = system.source;
  for (int left = settings.max_iterations; left > 0;) {
    const Matrix before = system.source - x + reflected(system, x);
    if (!(goal.missed(before, x) != 0.0).any())
      break;
    left -= std::max(1, run(system, goal, std::min(left, max_steps_of_run), x));
    const Matrix after = system.source - x + reflected(system, x);
    constexpr double progress = 0.5; // a run that leaves more than this share everywhere is the last
    if (!(norms(after) <= progress * norms(before) && norms(before) > 0.0).any())
      break;
  }
  return light_of(x.cwiseMax(system.source)); // light only adds to what is there without bounces
}

} // namespace meninas
