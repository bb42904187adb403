// A bound of an iterate's error from its residual alone, and the test whether there is a solution.
//
// The error e = B - B_k solves (1 - rho T) e = r_k, so ||e|| <= G ||r_k|| with the amplification
// G = ||(1 - rho T)^-1||, in the maximum norm. The inverse 1 + rho T + (rho T)^2 + ...
// is not negative, so that its norm is that of its row sums, the solution of (1 - rho T) g = 1.
// For any approximation g_k with the residual q = 1 - (1 - rho T) g_k,
//   G = ||g_k + (1 - rho T)^-1 q|| <= ||g_k|| + G ||q||,   so   G <= ||g_k|| / (1 - ||q||)   where ||q|| < 1.
// The bound is sharp, and what is left of it is known: G itself is at least ||g_k|| / (1 + ||q||).
// The series ends only where rho T loses more than it returns on every way round. A positive g with ||q|| < 1 says so:
// (1 - rho T) g > 0 with g > 0 makes 1 - rho T an M-matrix (Berman and Plemmons 1994, ch. 6), and only then has it such a
// g. Rows of few rays to coats may gather more than all there is, and together more than is absorbed: g then is
// negative somewhere and there is no bound.
// Only rows that light reaches count, with 1 = 0 elsewhere: in the others B, B_k and r_k are 0,
// and g with them. (The inside of a closed white shell would make G infinite, and nobody sees it.)
#pragma once

#include "radiosity/transport/linear_system.h"

#include <span>

namespace meninas {

/// By row and channel: 1 where light arrives, directly or from rows where it does;
/// 0 elsewhere, where B, its iterates and their residuals are 0.
template <typename Value>
std::vector<Value> lit_rows(const LinearSystem<Value>& system);

/// G by channel, at most a quarter too large; infinite where no bound was found in so many iterations, or none is.
template <typename Value>
Value amplification_bound(const LinearSystem<Value>& system, int max_iterations);

/// The mean over area of |e| / B_k, each at most 1, by channel: how far off a place is, whatever shines elsewhere.
/// As e = r + rho T r + (rho T)^2 r + ..., and neither factor is negative,
///   |e|  <=  p_0 + p_1 + p_2 + ...,      p_m = (rho T)^m |r|,
/// of which a few are summed. The rest is an estimate: a geometric series by the ratio of the last two in that mean.
/// The bound above is relative to the brightest spot, and too wide for walls by as much as they are darker.
template <typename Value>
Value relative_error(const LinearSystem<Value>& system, const std::vector<Value>& x,
                     std::span<const double> areas);

/// ||rho T||: what is left of a change after one bounce, by channel.
template <typename Value>
Value contraction(const LinearSystem<Value>& system);

/// By row and channel: 0 in parts of the scene that light cannot leave and that absorb nothing,
/// rows that reflect all they gather, all of it from one another; 1 elsewhere.
/// (Then, and only then, 1 - rho T is singular: a weakly chained diagonally dominant matrix is not.)
template <typename Value>
std::vector<Value> open_rows(const LinearSystem<Value>& system);

/// The system whose traps reflect nothing: in them no solution would end. Where no light is nothing changes.
template <typename Value>
LinearSystem<Value> without_traps(LinearSystem<Value> system, const std::vector<Value>& open);

} // namespace meninas
