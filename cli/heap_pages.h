// Memory that is freed stays with the program, in large pages.
//
// Pass one fills arrays of hundreds of megabytes and lets go of them from step to step. By default the C library
// gives each back to the system, which hands out zeroed pages of 4 kB anew: a third of the time of a room of
// 368,190 triangles. Here arrays come from one heap that never shrinks, and of which as much as a quarter of the
// machine's memory is asked to be of pages of 2 MB (madvise(2), MADV_HUGEPAGE).
// Limits: glibc on Linux, elsewhere nothing happens; what a run needed at most it keeps until it ends;
// threads other than the first have mappings of their own for large blocks.
#pragma once

namespace meninas {

/// To be called before anything large is allocated.
void keep_heap_in_large_pages();

} // namespace meninas
