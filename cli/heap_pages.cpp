#include "cli/heap_pages.h"

#include <cstdlib>

// Sanitizers have heaps of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define MENINAS_HAS_GLIBC_HEAP
#endif

#ifdef MENINAS_HAS_GLIBC_HEAP
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace meninas {

void keep_heap_in_large_pages() {
#ifdef MENINAS_HAS_GLIBC_HEAP
  // No block is a mapping of its own, and the end of the heap is never given back.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);

  // The heap grows by a block that is advised and freed; none of it is touched, and so none is taken yet.
  const long pages = sysconf(_SC_PHYS_PAGES), page_size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_size <= 0)
    return;
  const auto page = static_cast<std::uintptr_t>(page_size);
  const std::uintptr_t size = static_cast<std::uintptr_t>(pages) / 4 * page;
  void* const block = std::malloc(size);
  if (block == nullptr)
    return;
  const auto address = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (address / page + 1) * page, end = (address + size) / page * page;
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  std::free(block);
#endif
}

} // namespace meninas
