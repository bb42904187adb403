// Loops over the rays of a stage, and their rates on one thread.
#pragma once

#include "bench/bare_embree.h"
#include "bench/stage_rays.h"

#include <functional>
#include <vector>

namespace meninas::bench {

/// Returns how many rays it has traced.
using RayLoop = std::function<std::uint64_t()>;

/// Million rays a second, in processor time of this thread.
double rate_of(const RayLoop& loop);

double median(std::vector<double> values);

/// A bare loop over the rays of a stage, told of their coherence as traces them best.
RayLoop bare_loop(const BareScene& bare, const StageRays& rays, Coherence first);

} // namespace meninas::bench
