// Giving memory back.
#pragma once

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace deliso {

// Gives the pages of memory that has been freed back to the system, where the allocator would keep them between others
// that are in use: for the end of a stage that has made and dropped much.
inline void give_back_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace deliso
