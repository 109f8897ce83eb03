// What an allocator keeps of memory that was freed.
#pragma once

#include <cstdlib>  // tells which library it is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace deliso {

// Gives it back to the system, so that the peak of what comes next does not add to it. To be called after a stage that
// freed much in small pieces; takes milliseconds.
inline void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

// From now on the allocator takes every large array from the system and gives it back at once, instead of keeping room
// for it among small ones. To be called by a program, not by a library: it holds for the whole process.
inline void give_back_large_arrays_at_once() {
#ifdef __GLIBC__
  constexpr int kLarge = 1 << 18;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, 4 * kLarge);
#endif
}

}  // namespace deliso
