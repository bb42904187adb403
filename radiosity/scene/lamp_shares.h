// The share of each lamp in the light that emitters send.
//
// Lamps are those of scenes/lamps.h. An emitter of a scene is of one lamp. A secondary emitter
// (light/secondary_emitters.h) reflects the light of several: by channel the share of lamp l is
// s_l = B_l / B, dimensionless, with sum s_l = 1. Arriving light is divided by these shares while it
// is gathered, so that the parts by lamp are parts of the same sum.
#pragma once

#include "scenes/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace meninas {

/// A row for each of many places; number 3 l + c of a row is that of channel c of lamp l.
template <typename Number> struct TableByLamp {
  std::size_t rows = 0, columns = 0;
  std::vector<Number> values = std::vector<Number>(rows * columns); ///< row by row

  std::span<Number> operator[](std::size_t row) {
    return {values.data() + row * columns, columns};
  }
  std::span<const Number> operator[](std::size_t row) const {
    return {values.data() + row * columns, columns};
  }
};
using LightByLamp = TableByLamp<double>; ///< W/m^2; empty: not asked for
using SharesByLamp = TableByLamp<float>; ///< floats, for what many rays read

/// The lamps of the emitters, sides and lights of a Lighting.
struct LampShares {
  std::size_t count = 0;                  ///< of lamps; 0: light is not told apart
  std::vector<std::uint32_t> of_emitter;  ///< the one lamp of each
  SharesByLamp of_cluster, of_node;       ///< of secondary emitters, and of nodes of their tree
  std::vector<std::uint32_t> of_side;     ///< by SideId: of what it emits, `no_lamp` where nothing
  std::vector<std::uint32_t> of_punctual; ///< by place in LightScene::punctual
  std::uint32_t sky = 0;

  explicit operator bool() const { return count > 0; }
};

/// The irradiance at a point so far, by lamp, W/m^2.
using ArrivedByLamp = std::vector<Rgb>;

/// Adds what one row of shares is of `arrived`.
inline void add_shares(const SharesByLamp& shares, std::size_t row, const Rgb& arrived,
                       ArrivedByLamp& sum) {
  const std::span<const float> share = shares[row];
  for (std::size_t l = 0; l < sum.size(); ++l)
    sum[l] += Rgb(share[3 * l], share[3 * l + 1], share[3 * l + 2]) * arrived;
}

/// Adds what has arrived of an emitter.
inline void add_of_emitter(const LampShares& lamps, std::uint32_t emitter, const Rgb& arrived,
                           ArrivedByLamp& sum) {
  if (!lamps.of_emitter.empty())
    sum[lamps.of_emitter[emitter]] += arrived;
  else
    add_shares(lamps.of_cluster, emitter, arrived, sum);
}

/// Rows of `parts` in proportion, so that they add up to `whole`, by channel. Rows of which nothing
/// is known but that have some light are left as they are.
void add_up_to(const std::vector<Rgb>& whole, LightByLamp& parts);

/// Rows of colours, one of each lamp.
void set_row(LightByLamp& light, std::size_t row, const ArrivedByLamp& values);
std::vector<Rgb> light_of_lamp(const LightByLamp& light, std::size_t lamp);
void set_light_of_lamp(LightByLamp& light, std::size_t lamp, const std::vector<Rgb>& values);
LightByLamp no_light(std::size_t rows, std::size_t lamps);
LightByLamp& operator+=(LightByLamp& light, const LightByLamp& more);

} // namespace meninas
