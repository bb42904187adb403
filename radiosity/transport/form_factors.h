// Transport between elements: the rows of Eq. 1, by rays over the hemisphere of each element.
//
// Row i of the transport is  sum_w tau_w F^w_ij  over all mirror worlds w.
// `rays`: N cosine-distributed rays from low-discrepancy points spread
// over element i (Malley's method): F_ij = (rays that land on j) / N.
// `hemicube`: one hemicube at the centre of element i,
// F_ij = sum of the delta form factors of its cells that land on j (hemicube.h);
// what is near is seen as from the centre alone (element_hemicube.h).
// A ray that meets a mirror is reflected exactly and goes on with the product of reflectances tau,
// to any depth: it ends when it lands, escapes, meets a black back,
// when tau falls below `min_throughput`, or after `max_bounces`.
// So a row closes, exactly by counts of rays, to rounding by delta form factors:
//   landed + escaped + black + cut = 1.
// Where something stands on an element (cells whose every ray meets a black back at once),
// the row speaks of the exposed rest.
// Emission is not part of the rows: light that comes straight from an emitter, or by mirrors,
// is the direct irradiance (direct_irradiance.h), and what no closed form owns (deep worlds,
// facets, large emitters) is found from the rows (gathered_emission.h).
// So form factors do not depend on what emits how much,
// nor on diffuse reflectances, and may be kept for other light (factor_file.h).
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/receiver_rays.h"
#include "scenes/progress.h"

#include <functional>

namespace meninas {

/// `analytic` is analytic_transport.h.
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

/// What became of the rays of each row, as fractions of all, and of the light they carry:
/// landed + escaped + black + mirror_absorbed + cut = 1 in either.
/// The light that is cut is shared out among the rest in proportion.
struct RowClosure {
  float landed = 0.0F, escaped = 0.0F, black = 0.0F, cut = 0.0F;
  glm::vec3 mirror_absorbed{0.0F}; ///< sum over rays of 1 - tau at their end
  glm::vec3 escaped_light{0.0F}, black_light{0.0F}, cut_light{0.0F}; ///< sums over rays of tau
};

struct FormFactors {
  Transport transport;
  Transport beyond; ///< the part in which no closed form owns emission: beyond the enumerated worlds (deep chains, facets); all of `analytic`
  std::vector<RowClosure> closure;      ///< by ElementId
  std::vector<std::uint64_t> covered;   ///< by ElementId: the cells on which something stands (gather_rays.h)
  std::vector<float> exposed;           ///< by ElementId: the share of the area that is there and on which nothing stands
  std::uint64_t rays_traced = 0;        ///< legs, reflected ones included
};

FormFactors assemble_transport(const LightScene& light, const FormFactorSettings& settings, const Progress& progress = {});

/// What a row may speak of besides an element:
/// a part of a surface (receiver_rays.h), by row. Called from any thread.
using RowReceiver = std::function<ReceiverArea(std::size_t row)>;

/// The same for other receivers, by rays or hemicubes:
/// what is by ElementId there is by row, columns are elements as ever.
/// The exposed share is that of the receiver's area, whatever is cut out of it.
FormFactors assemble_rows(const LightScene& light, std::size_t rows, const RowReceiver& receiver,
                          const FormFactorSettings& settings, const Progress& progress = {});

} // namespace meninas
