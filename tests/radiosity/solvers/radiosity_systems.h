// Small radiosity systems with known solutions, for tests of solvers.
#pragma once

#include "radiosity/solvers/solve.h"
#include "tests/support/random.h"

#include <Eigen/Dense>

namespace meninas::test {

struct System {
  Transport transport;
  std::vector<Rgb> source, reflectance;
};

/// A transport of one or three bands from dense matrices.
Transport transport_of(const std::vector<Eigen::MatrixXd>& bands);

/// Rows of the first band sum to one, as in a closed room; of the others to less.
System random_system(Random& random, int size, int bands, double highest_reflectance,
                     double emission = 1.0);

/// Reciprocal: A_i F_ij = A_j F_ji, rows that sum to at most `closure`,
/// areas over `orders` orders of magnitude.
struct ReciprocalSystem {
  System system;
  std::vector<double> area;
};
ReciprocalSystem reciprocal_system(Random& random, int size, double orders, double closure);

/// By elimination in long double, of the system with its weights as the floats they are.
std::vector<Rgb> exact_solution(const System& system);

/// ||B - B_k|| / ||B_k|| in the maximum norm, worst channel: what the error bound bounds.
double true_error(const std::vector<Rgb>& exact, const std::vector<Rgb>& x);

} // namespace meninas::test
