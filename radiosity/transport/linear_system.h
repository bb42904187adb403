// The linear system of radiosity for solvers:
// x = S + rho T x, for all channels at once (Value = Rgb) or a grey one (Value = double).
//
// x and S in W/m^2, rho and T dimensionless.
// Channels never mix: arithmetic on Value is by channel, and so are norms and inner products.
// Sums run in a fixed order.
#pragma once

#include "radiosity/scene/lamp_shares.h"
#include "radiosity/transport/form_factor_rows.h"

#include <vector>

namespace meninas {

/// Refers to a transport that outlives it; of one band when Value is double.
template <typename Value>
struct LinearSystem {
  const Transport& transport;
  std::vector<Value> source, reflectance; ///< S and rho, by row
};

/// Appends a row of one table to another with as many bands.
void append_row(const Transport& from, std::size_t row, Transport& to);

/// T x, for rows of any number; x has a value for every column
template <typename Value>
std::vector<Value> transport_product(const Transport& transport, const std::vector<Value>& x);

/// The same of the light of every lamp: x has a row for every column of T.
LightByLamp transport_product(const Transport& transport, const LightByLamp& x);

/// rho T x
template <typename Value>
std::vector<Value> reflected(const LinearSystem<Value>& system, const std::vector<Value>& x);

/// r = S + rho T x - x
template <typename Value>
std::vector<Value> residual_of(const LinearSystem<Value>& system, const std::vector<Value>& x);

/// Relaxes rows `begin` to `end` from the same x, in place, and returns the largest change.
template <typename Value>
Value relax_rows(const LinearSystem<Value>& system, std::size_t begin, std::size_t end,
                 std::vector<Value>& x, std::vector<Value>& scratch);

/// max |x|, by channel
template <typename Value>
Value maximum_norm(const std::vector<Value>& x);

template <typename Value>
Value inner_product(const std::vector<Value>& a, const std::vector<Value>& b);

inline double& channel(double& value, int) { return value; }
inline double& channel(Rgb& value, int band) { return value[band]; }
inline double channel(const double& value, int) { return value; }
inline double channel(const Rgb& value, int band) { return value[band]; }
template <typename Value>
inline constexpr int channel_count = sizeof(Value) / sizeof(double);

inline double worst(double value) { return value; }
inline double worst(const Rgb& value) { return glm::max(value.r, glm::max(value.g, value.b)); }

/// a / b by channel, and 0 where a is: a channel in which nothing is left has no share of anything.
template <typename Value>
Value share_of(const Value& a, const Value& b) {
  Value share(0.0);
  for (int band = 0; band < channel_count<Value>; ++band)
    if (channel(a, band) != 0.0)
      channel(share, band) = channel(a, band) / channel(b, band);
  return share;
}

} // namespace meninas
