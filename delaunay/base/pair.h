// Two numbers that are worked on together, in a register that every 64-bit processor has.
#pragma once

namespace deliso {

// A vector type of GCC and Clang.
using Pair = double __attribute__((vector_size(16)));
inline Pair swapped(Pair a) { return Pair{a[1], a[0]}; }

}  // namespace deliso
