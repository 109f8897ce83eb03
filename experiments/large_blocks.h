// Large blocks of memory, of all vectors and strings of the program, in huge pages, given back when they are freed.
//
// For runs of some 10,000 vertices and more on machines where a fresh page takes the system long, as virtual ones: by
// turns 0.84 to 0.94 of the time, and half of the page faults (tests/bench/README.md). The library leaves memory to the
// programs that use it, and sanitizers have allocators of their own.
#pragma once

namespace deliso {

// To be called before anything is allocated that is to be large. The operators new and delete of large_blocks.cpp do
// the rest. Nothing happens on other systems than Linux with glibc.
void use_large_blocks();

}  // namespace deliso
