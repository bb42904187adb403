// Transport between elements: the rows of Eq. 1, by quasi-Monte Carlo rays (`rays`).
//
// Row i of the transport is  sum_w tau_w F^w_ij  over all mirror worlds w, estimated by N cosine-distributed rays from low-discrepancy
// points spread over element i (Malley's method): F_ij = (rays that land on j) / N. A ray that meets a mirror is reflected
// exactly and goes on with the product of reflectances tau, to any depth: it ends when it lands, escapes, meets a black back, when tau falls
// below `min_throughput`, or after `max_bounces`. Counts are integers, so that a row closes exactly:
//   landed + escaped + black + cut = N.
// Emission is not part of the rows: light that comes straight from an emitter, or by mirrors, is the direct irradiance
// (direct_irradiance.h); `gathered_emission` holds the emission that no closed form owns (deep worlds, facets, large emitters).
#pragma once

#include "mirror/virtual_lights.h"
#include "radiosity/element_mesh.h"
#include "scenes/ray_scene.h"

namespace meninas {

enum class FormFactorMethod { rays };

struct FormFactorSettings {
  FormFactorMethod method = FormFactorMethod::rays;
  int rays = 512;                ///< per element, a power of two
  double min_throughput = 1e-4;  ///< a chain of mirrors is followed while tau can matter
  int max_bounces = 10'000;      ///< ends chains between perfect mirrors; the light cut so is reported as closure.cut
  std::uint32_t seed = 0;
};

/// The sparse transport operator, row by row. One band when no mirror is coloured, else three.
struct Transport {
  std::size_t size = 0;
  int bands = 1;
  std::vector<std::uint64_t> row_begin; ///< size + 1
  std::vector<std::uint32_t> columns;
  std::vector<float> weights; ///< entry k, band b at [k * bands + b]: sum_w tau_w F^w
};

/// What became of the rays of each row, as fractions of N.
struct RowClosure {
  float landed = 0.0F, escaped = 0.0F, black = 0.0F, cut = 0.0F;
  glm::vec3 mirror_absorbed{0.0F}; ///< sum over rays of 1 - tau at their end
};

struct FormFactors {
  Transport transport;
  std::vector<RowClosure> closure;      ///< by ElementId
  std::vector<Rgb> gathered_emission;   ///< by ElementId: irradiance from emission that no closed form owns
  std::uint64_t rays_traced = 0;        ///< legs, reflected ones included
};

/// Everything pass one looks things up in while it gathers; all of it outlives the call.
struct LightScene {
  const Scene& scene;
  const SurfaceModel& surfaces;
  const RayScene& rays;
  const MirrorSet& mirrors;
  const WorldTree& worlds;
  const ElementMesh& mesh;
  std::vector<Emitter> emitters;         ///< those whose light is computed from the source
  std::vector<std::uint8_t> from_source; ///< by SideId: its emission is owned by the closed form in enumerated worlds
};

/// Emitters are taken from the source when they are few and small; those that are most of what is seen (more than half of
/// the meshed area) are gathered like everything else, which is then exact where all walls glow.
LightScene make_light_scene(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                            const MirrorSet& mirrors, const WorldTree& worlds, const ElementMesh& mesh);

FormFactors assemble_transport(const LightScene& light, const FormFactorSettings& settings);

} // namespace meninas
