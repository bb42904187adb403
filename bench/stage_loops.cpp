#include "bench/stage_loops.h"

#include <time.h>

#include <algorithm>
#include <memory>

namespace meninas::bench {

static constexpr int bare_repetitions = 8;

static double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double rate_of(const RayLoop& loop) {
  const double start = thread_seconds();
  const std::uint64_t rays = loop();
  return 1e-6 * static_cast<double>(rays) / (thread_seconds() - start);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

RayLoop bare_loop(const BareScene& bare, const StageRays& rays, Coherence first) {
  return [bare, &rays, first, met = std::make_shared<std::uint64_t>(0)] {
    for (int repetition = 0; repetition < bare_repetitions; ++repetition) {
      for (const RayPacket& packet : rays.first)
        *met += trace_bare(bare, Query::closest, first, packet);
      for (const RayPacket& packet : rays.reflected)
        *met += trace_bare(bare, Query::closest, Coherence::incoherent, packet);
    }
    return bare_repetitions * packet_size * (rays.first.size() + rays.reflected.size());
  };
}

} // namespace meninas::bench
