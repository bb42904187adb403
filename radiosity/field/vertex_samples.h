// The samples at the vertices of a mesh while the irradiance field is found, and the means to gather them.
//
// Each vertex is one sample: irradiance, W/m^2, by ElementVertexId, with the state it is in.
#pragma once

#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"
#include "radiosity/field/vertex_places.h"
#include "radiosity/light/row_cache.h"
#include "radiosity/light/point_irradiance.h"
#include "scenes/progress.h"
#include "scenes/sampling.h"

#include <tbb/enumerable_thread_specific.h>

#include <span>

namespace meninas {

/// The state of a vertex; `smoothed`: it has the mean of its facets;
/// `low_clearance`: all light, under a low cover that goes on all around (vertex_light.h).
enum class VertexState : std::uint8_t { unknown, covered, smoothed, direct_only, low_clearance, gathered };

inline bool has_value(VertexState state) {
  return state == VertexState::smoothed || state == VertexState::low_clearance ||
         state == VertexState::gathered;
}

/// The visibility of the emitters' images from a vertex: each wholly or not at all, as few samples tell
/// (`uniform`) or many (`confirmed`), or one in part (penumbra_resampling.h).
enum class Visibility : std::uint8_t { uniform, confirmed, partial };

/// A mesh with the values of vertices as they were found; hanging vertices may be unknown.
struct VertexSamples {
  ElementMesh mesh;
  VertexIrradiance field;
  std::vector<VertexState> states; ///< by ElementVertexId
  std::vector<Visibility> seen;    ///< likewise, of those that have direct light
  std::vector<Receiver> receivers; ///< where they gather (vertex_places.h)
  VertexElements around;
  std::vector<glm::vec3> entering; ///< what punctual and area lights send; empty: not asked for
};

using PointWorkspaces = tbb::enumerable_thread_specific<PointWorkspace>;

/// Adds the rays that were traced with the workspaces.
inline void count_rays(const PointWorkspaces& workspaces, InterpolatedField& result) {
  for (const PointWorkspace& work : workspaces) {
    result.form_factor_rays += work.rays;
    result.shadow_rays += work.direct.shadow_rays;
  }
}

/// The settings by which vertices gather.
struct VertexGathering {
  const FormFactorSettings& form_factors;
  const DirectSettings& direct;
  const InterpolationSettings& interpolation;
  const Progress& progress;
  std::span<const std::uint8_t> seen = {}; ///< by ElementId (SeenElements); empty: all are
  std::span<const float> seen_direct = {}; ///< likewise, how much its direct light weighs that is the field's
};

/// Rays per vertex = times x max(min(N, 128), N / part).
struct RayShare {
  int part = 1, times = 1;
};

/// The light that vertices gather from.
struct VertexSource {
  const std::vector<Rgb>& irradiance; ///< by ElementId: tells which elements are lit
  const PointGathering& gathering;
  PointWorkspaces& workspaces;
  RowCache* kept = nullptr; ///< of gather_at_lit()
  bool keeps_more = false;
  StagePart part = {}; ///< of the run: reported by the vertices that are done
  std::span<const std::uint8_t> seen = {}; ///< by ElementVertexId; empty: all are
};

/// Whether the vertex is a corner of a seen element: others only tell how much light elements reflect.
inline bool is_seen(const VertexSource& source, std::uint32_t vertex) {
  return source.seen.empty() || source.seen[vertex] != 0;
}

/// The seed of a vertex's samples. `level` tells apart vertices whose numbers are the same.
inline std::uint32_t vertex_seed(const VertexSource& source, std::uint32_t vertex,
                                 std::uint32_t level) {
  return hash(vertex, source.gathering.form_factors.seed, 0x7e27 + level);
}

} // namespace meninas
