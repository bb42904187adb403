// Rows of form factors: what receivers get of what elements send (form_factors.h).
//
//   H_i = sum_j T_ij B_j,    T_ij = sum over worlds w of tau_w F^w_ij,    landed + escaped + black + cut = 1
#pragma once

#include "radiosity/transport/hemisphere_samples.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace meninas {

/// `analytic` is analytic_rows.h.
enum class FormFactorMethod { rays, hemicube, analytic };

struct FormFactorSettings {
  FormFactorMethod method = FormFactorMethod::rays;
  int rays = 512;                ///< per element, a power of two
  int hemicube_resolution = 64;  ///< cells along an edge of the top of a hemicube, even
  double min_throughput = 1e-4;  ///< a chain of mirrors is followed while tau can matter
  int max_bounces = 10'000;      ///< ends chains between perfect mirrors; the light cut so is reported as closure.cut
  double accuracy = 1e-4;        ///< analytic: wanted of each row, relative to its light
  std::uint32_t seed = 0;
  bool relightable = false; ///< whether `beyond` speaks of all elements, or of those that emit now
};

/// The sparse transport operator, row by row. One band when no mirror is coloured, else three.
struct Transport {
  std::size_t size = 0;
  int bands = 1;
  std::vector<std::uint64_t> row_begin; ///< size + 1
  std::vector<std::uint32_t> columns;
  std::vector<float> weights; ///< entry k, band b at [k * bands + b]: sum_w tau_w F^w
};

/// The ends of the rays of each row, as fractions of all rays, and of the light they carry:
/// landed + escaped + black + mirror_absorbed + cut = 1 in either.
/// The light that is cut is shared out among the rest in proportion.
struct RowClosure {
  float landed = 0.0F, escaped = 0.0F, black = 0.0F, cut = 0.0F;
  glm::vec3 mirror_absorbed{0.0F}; ///< sum over rays of 1 - tau at their end
  glm::vec3 escaped_light{0.0F}, black_light{0.0F}, cut_light{0.0F}; ///< sums over rays of tau
  glm::vec3 sky{0.0F}; ///< sum over escaped rays of tau L, of a sky that is not even; W/m^2/sr
  glm::vec3 owned_light{0.0F}; ///< of `escaped_light`, what portals bring (sky_portals.h)
  glm::vec3 by_portals{0.0F}; ///< as `sky`, by portals
};

struct FormFactors {
  Transport transport;
  Transport beyond; ///< the part in which no closed form owns emission: beyond the enumerated worlds (deep chains, facets); all of `analytic`
  std::vector<RowClosure> closure;      ///< by ElementId
  std::vector<std::uint64_t> covered;   ///< by ElementId: the cells on which something stands (hemisphere_rays.h)
  std::vector<float> exposed;           ///< by ElementId: the share of the area that is there and on which nothing stands
  std::uint64_t rays_traced = 0;        ///< legs, reflected ones included
};

/// Rows from `first` on.
struct RowRange {
  std::size_t first = 0, count = 0;
};

/// Part `number` of `count`, from 0, of so many rows: as many as any other, but for one.
inline RowRange rows_of_part(std::size_t rows, std::size_t number, std::size_t count) {
  const std::size_t first = rows * number / count;
  return {first, rows * (number + 1) / count - first};
}

/// The receivers of rows that are not elements:
/// a part of a surface (hemisphere_samples.h), by row. Called from any thread.
using RowReceiver = std::function<ReceiverArea(std::size_t row)>;

} // namespace meninas
