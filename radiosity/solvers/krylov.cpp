#include "radiosity/solvers/solvers.h"

namespace meninas {

namespace {

/// A x = x - rho T x
template <typename Value>
std::vector<Value> system_product(const LinearSystem<Value>& system, const std::vector<Value>& x) {
  std::vector<Value> product = reflected(system, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    product[i] = x[i] - product[i];
  return product;
}

/// a += factor * b
template <typename Value>
void add(std::vector<Value>& a, const Value& factor, const std::vector<Value>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    a[i] += factor * b[i];
}

/// a / b by channel, 0 where that is no number:
/// nothing is left in the channel, or the recurrence has broken down.
template <typename Value>
Value coefficient(const Value& a, const Value& b) {
  Value quotient(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    if (glm::abs(channel(b, band)) >= std::numeric_limits<double>::min())
      channel(quotient, band) = channel(a, band) / channel(b, band);
  return quotient;
}

} // namespace

template <typename Value>
void bicgstab_run(const LinearSystem<Value>& system, std::vector<Value>& x,
                  const Unfinished<Value>& unfinished) {
  std::vector<Value> r = residual_of(system, x);
  const std::vector<Value> shadow = r;
  std::vector<Value> p = r;
  Value rho = inner_product(shadow, r);
  Value active = unfinished(maximum_norm(r), maximum_norm(x));
  while (active != Value(0.0)) {
    // Along p as far as makes the residual orthogonal to the shadow, ...
    const std::vector<Value> v = system_product(system, p);
    const Value alpha = active * coefficient(rho, inner_product(shadow, v));
    add(x, alpha, p);
    add(r, -alpha, v);

    // ... and along what is left of the residual as far as makes it shortest.
    const std::vector<Value> t = system_product(system, r);
    const Value omega = active * coefficient(inner_product(t, r), inner_product(t, t));
    add(x, omega, r);
    add(r, -omega, t);
    active *= unfinished(maximum_norm(r), maximum_norm(x));

    // The next direction is conjugate to this one; a channel without one has broken down.
    const Value next = inner_product(shadow, r);
    const Value beta = coefficient(next, rho) * coefficient(alpha, omega);
    for (int band = 0; band < channel_count<Value>; ++band)
      if (channel(beta, band) == 0.0)
        channel(active, band) = 0.0;
    add(p, -omega, v);
    for (std::size_t i = 0; i < p.size(); ++i)
      p[i] = r[i] + beta * p[i];
    rho = next;
  }
}

template <typename Value>
void bicgstab(const LinearSystem<Value>& system, std::vector<Value>& x,
              Convergence<Value>& convergence) {
  constexpr double progress =
      0.5; // a run that leaves more than this share of the residual is the last
  record(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
  while (!finished(convergence)) {
    const double before = worst(convergence.error_bounds.back());
    int steps = -1; // the run begins with the iterate that is recorded already
    bicgstab_run<Value>(system, x, [&](const Value& residual, const Value& size) {
      if (++steps > 0) {
        ++convergence.iterations;
        record(convergence, residual, size);
      }
      return steps < max_steps_of_run ? unfinished_channels(convergence) : Value(0.0);
    });

    record_again(convergence, maximum_norm(residual_of(system, x)), maximum_norm(x));
    if (!(worst(convergence.error_bounds.back()) <= progress * before))
      return;
  }
}

template void bicgstab_run(const LinearSystem<Rgb>&, std::vector<Rgb>&, const Unfinished<Rgb>&);
template void bicgstab_run(const LinearSystem<double>&, std::vector<double>&,
                           const Unfinished<double>&);
template void bicgstab(const LinearSystem<Rgb>&, std::vector<Rgb>&, Convergence<Rgb>&);
template void bicgstab(const LinearSystem<double>&, std::vector<double>&, Convergence<double>&);

} // namespace meninas
