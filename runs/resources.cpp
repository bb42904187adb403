#include "runs/resources.h"

#include <oneapi/tbb/info.h>
#include <sys/resource.h>

namespace meninas {

ThreadLimit::ThreadLimit(int threads)
    : threads_(threads > 0 ? threads : tbb::info::default_concurrency()),
      control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_)) {}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  // Linux counts kibibytes.
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

} // namespace meninas
