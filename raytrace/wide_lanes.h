// Loops over lanes, compiled for wide registers as well.
//
// A function that is marked so is there three times, for processors with registers of 128,
// 256 and 512 bits, and the first call takes the widest that this one has.
// The operations on a lane are the same in all of them,
// none is contracted or reordered (cmake/ProjectOptions.cmake): hence the same bits.
// Functions called in its loops must be inline. Other compilers and processors have only the first
// version; so do sanitizers, which are not ready yet when the choice is made.
#pragma once

#include <cstddef> // for __GLIBC__

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) &&       \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define MENINAS_WIDE_LANES                                                                         \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define MENINAS_WIDE_LANES
#endif
