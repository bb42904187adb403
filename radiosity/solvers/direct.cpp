#include "radiosity/solvers/error_bound.h"
#include "radiosity/solvers/solvers.h"

#include <Eigen/LU>

#include <algorithm>

namespace meninas {

namespace {

using Lu = Eigen::PartialPivLU<Eigen::MatrixXd>;

/// 1 - rho T of one channel, and the unit matrix in rows that no light reaches:
/// among those the system may be singular.
template <typename Value>
Eigen::MatrixXd dense(const LinearSystem<Value>& system, const std::vector<Value>& lit, int band) {
  const Transport& transport = system.transport;
  const auto size = static_cast<Eigen::Index>(transport.size);
  const auto bands = static_cast<std::size_t>(transport.bands);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  for (std::size_t i = 0; i < transport.size; ++i) {
    if (channel(lit[i], band) == 0.0)
      continue;
    for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k) {
      const std::size_t entry = k * bands + (bands == 1 ? 0 : static_cast<std::size_t>(band));
      matrix(static_cast<Eigen::Index>(i), transport.columns[k]) -=
          channel(system.reflectance[i], band) * double{transport.weights[entry]};
    }
  }
  return matrix;
}

/// Channels whose walls and mirrors are alike, and lit alike, have the same matrix.
template <typename Value>
bool same_matrix(const LinearSystem<Value>& system, const std::vector<Value>& lit, int band,
                 int other) {
  const auto alike = [&](const Value& value) {
    return channel(value, band) == channel(value, other);
  };
  return system.transport.bands == 1 && std::ranges::all_of(system.reflectance, alike) &&
         std::ranges::all_of(lit, alike);
}

/// x += (1 - rho T)^-1 r for one channel
template <typename Value>
void correct(const Lu& lu, const std::vector<Value>& residual, int band, std::vector<Value>& x) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i)
    r(static_cast<Eigen::Index>(i)) = channel(residual[i], band);
  const Eigen::VectorXd correction = lu.solve(r);
  for (std::size_t i = 0; i < x.size(); ++i)
    channel(x[i], band) += correction(static_cast<Eigen::Index>(i));
}

} // namespace

template <typename Value>
void factorise_and_solve(const LinearSystem<Value>& system, std::vector<Value>& x,
                         Convergence<Value>& convergence) {
  constexpr int max_corrections = 3; // the first is the solution, the others refine it
  std::vector<Value> residual = residual_of(system, x);
  record(convergence, maximum_norm(residual), maximum_norm(x));
  if (finished(convergence))
    return;
  const std::vector<Value> lit = lit_rows(system);
  std::vector<Lu> factors;
  std::vector<std::size_t> factors_of;
  for (int band = 0; band < channel_count<Value>; ++band) {
    if (band == 0 || !same_matrix(system, lit, band - 1, band))
      factors.emplace_back(dense(system, lit, band));
    factors_of.push_back(factors.size() - 1);
  }
  while (!finished(convergence) && convergence.iterations < max_corrections) {
    for (int band = 0; band < channel_count<Value>; ++band)
      correct(factors[factors_of[static_cast<std::size_t>(band)]], residual, band, x);
    ++convergence.iterations;
    residual = residual_of(system, x);
    record(convergence, maximum_norm(residual), maximum_norm(x));
  }
}

template void factorise_and_solve(const LinearSystem<Rgb>&, std::vector<Rgb>&, Convergence<Rgb>&);
template void factorise_and_solve(const LinearSystem<double>&, std::vector<double>&,
                                  Convergence<double>&);

} // namespace meninas
