// Large blocks of memory, of all vectors and strings of the program, in huge pages, given back when they are freed.
//
// For runs of some 10,000 vertices and more on machines where a fresh page takes the system long, as virtual ones: by
// turns 0.89 to 0.95 of the time, and half of the page faults (tests/bench/README.md). The library puts in huge pages
// only what it reads at random (delaunay/base/huge_pages.h) and leaves the rest to the programs that use it; sanitizers
// have allocators of their own.
#pragma once

namespace deliso {

// To be called before anything is allocated that is to be large. The operators new and delete of large_blocks.cpp do
// the rest. Nothing happens on other systems than Linux with glibc.
void use_large_blocks();

}  // namespace deliso
