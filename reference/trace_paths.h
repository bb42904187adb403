// Path tracing (Kajiya 1986) with next-event estimation and multiple
// importance sampling (Veach 1997): sixteen paths at a time.
//
// Radiance that leaves x towards o:
//   L(x, o) = L_e(x, o) + integral f(x, o, i) L(y(x, i), -i) cos_i d i
// A path follows one direction i per vertex, drawn from the material's own density p_s;
// light that is emitted at y is also looked for from x by choosing y among the lights,
// with density p_l. Each is counted with the weight of the balance heuristic,
// p_s / (p_s + p_l) and p_l / (p_s + p_l), which add up to one for every path.
// Punctual lights, which are not met, are all looked for (light_images.h). Light over one or two
// plane mirrors is looked for as well (mirrored_lights.h); otherwise ideal lobes have no density:
// what they lead to is counted whole and never looked for. Paths end by Russian
// roulette with the survivors' weight raised, so that the expectation is untouched.
#pragma once

#include "reference/light_layers.h"
#include "reference/traced_scene.h"

#include <array>

namespace meninas::reference {

/// The way to find emitting surfaces. All ways have the same expectation: that is a test.
/// Punctual lights can only be chosen, lights behind long chains of mirrors only be met.
enum class LightSearch { both, choosing, meeting };

struct PathCounts {
  std::uint64_t camera_rays = 0, path_rays = 0, shadow_rays = 0;
};

/// The radiance that arrives along sixteen camera rays, or the first `count` of them,
/// by layer (light_layers.h). Path k uses point k of low-discrepancy sequences that belong to `seed`.
std::array<LayerRadiance, packet_size>
trace_paths(const TracedScene& traced, const std::array<CameraRay, packet_size>& camera_rays,
            std::uint32_t seed, LightSearch search, PathCounts& counts,
            std::size_t count = packet_size);

} // namespace meninas::reference
