// The machine's share a run takes: threads and memory.
#pragma once

#include <oneapi/tbb/global_control.h>

#include <cstdint>

namespace meninas {

/// No more than that many threads work while it lives; 0 stands for all the machine has.
class ThreadLimit {
public:
  explicit ThreadLimit(int threads);
  int threads() const { return threads_; }

private:
  int threads_;
  tbb::global_control control_;
};

/// The most memory this process has had resident so far, in bytes.
std::uint64_t peak_memory_bytes();

} // namespace meninas
