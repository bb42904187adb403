// The solvers proper. Each improves x until the convergence has finished,
// and records every iterate there, the first one included.
#pragma once

#include "radiosity/solvers/solver_settings.h"
#include "radiosity/solvers/convergence.h"

#include <functional>

namespace meninas {

enum class Relaxation { jacobi, gauss_seidel };

/// Sweeps of B_i = S_i + rho_i sum_j T_ij B_j over all rows.
/// A sweep that changes x by d leaves a residual of at most ||rho T|| ||d||,
/// since every row met values that were at most d away from the last ones:
/// that is what is recorded, at no cost, and the residual itself when it may have sufficed.
/// A watch is told of Jacobi's sweeps k = 1, 2, ... as if they were shots: T B_{k-1} has arrived, and
/// U = B_k - B_{k-1} is still to be sent on, so that B = S + rho T (B - U) at any time.
template <typename Value>
void relax(const LinearSystem<Value>& system, Relaxation order, std::vector<Value>& x,
           Convergence<Value>& convergence, const ShotWatch& watch = {});

/// Told ||r|| and ||x|| of an iterate,
/// answers 1 for every channel that needs more and 0 for the others.
template <typename Value>
using Unfinished = std::function<Value(const Value&, const Value&)>;

/// One run of BiCGStab (van der Vorst 1992), every channel with coefficients of its own,
/// from the residual of x until all have finished or the recurrence breaks down.
/// The residual it goes by is its own: after many iterations rounding sets it apart from that of x.
template <typename Value>
void bicgstab_run(const LinearSystem<Value>& system, std::vector<Value>& x,
                  const Unfinished<Value>& unfinished);

/// Steps of one run: recurrences that stand still, as in rooms that hardly absorb, are begun anew or given up.
inline constexpr int max_steps_of_run = 200;

/// Runs of BiCGStab, begun anew from the true residual until that suffices or falls no more.
template <typename Value>
void bicgstab(const LinearSystem<Value>& system, std::vector<Value>& x,
              Convergence<Value>& convergence);

/// Progressive radiosity over the columns of T, transposed in storage (shooting.h),
/// in the maximum norm. An iteration is a shot. Begins with all light unshot, whatever x is.
template <typename Value>
void shoot_stored(const LinearSystem<Value>& system, const ShotPlan& plan, std::vector<Value>& x,
                  Convergence<Value>& convergence);

/// LU with partial pivoting and iterative refinement, in dense storage.
template <typename Value>
void factorise_and_solve(const LinearSystem<Value>& system, std::vector<Value>& x,
                         Convergence<Value>& convergence);

} // namespace meninas
