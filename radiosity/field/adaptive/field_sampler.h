// What refinement asks of a field at points, and what it makes of the answers.
#pragma once

#include "radiosity/field/adaptive/mirror_outlines.h"
#include "radiosity/field/vertex_light.h"

#include <functional>

namespace meninas {

/// What arrives at a point; it counts where nothing is over it,
/// and under a low cover where nothing around is open.
struct PointSample {
  ArrivingLight light;
  Cover cover = Cover::open;
  double variance =
      0.0; ///< of the brightest channel of all light, as far as it is known: between vertices only
};

/// The sample at a point in elements of a size.
/// Called from any thread; the same for the same arguments.
using SamplePoint =
    std::function<PointSample(const Receiver& receiver, double element_size, std::uint32_t seed)>;
/// Whether a point is neither covered nor nearly so, under an edge.
using IsOpenPoint =
    std::function<bool(const Receiver& receiver, double element_size, std::uint32_t seed)>;
struct FieldSampler {
  SamplePoint at_vertices, between;
  IsOpenPoint is_open;
  SamplePoint quick =
      {}; ///< between vertices, for less, with variance 0; none: nothing is quicker
};

struct SampledField {
  ElementMesh mesh;
  std::vector<glm::vec3> total, mirrored; ///< by ElementVertexId, W/m^2
  double error = 0.0;                     ///< the root of sum eta^2 / A, as far as points tell
  double noise = 0.0;                     ///< sigma / H, the root of its mean square
};

} // namespace meninas
