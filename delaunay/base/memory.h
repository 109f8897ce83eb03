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

}  // namespace deliso
