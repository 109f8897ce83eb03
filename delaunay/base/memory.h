// Memory that the allocator still holds after it was freed.
#pragma once

#include <cstdlib>  // tells which library it is

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace deliso {

// Gives this memory back to the system, so that it does not add to the peak of the next stage. Call it after a stage
// that freed much memory in small pieces; it takes milliseconds.
inline void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace deliso
