// Conditions on several things side by side, as bits of a number. They are computed as masks instead of truth values,
// so that compilers can vectorize them and need no branches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace deliso {

inline std::uint32_t mask_of(bool condition) { return condition ? ~0U : 0U; }

// Bit i of `count`: whether condition(i), a mask, holds.
template <std::size_t count, class Condition>
[[gnu::always_inline]] inline std::uint32_t bits_where(const Condition& condition) {
  constexpr auto kBit = [] {
    std::array<std::uint32_t, count> bit{};
    for (std::size_t i = 0; i < count; ++i) bit[i] = std::uint32_t{1} << i;
    return bit;
  }();
  std::array<std::uint32_t, count> found;
  for (std::size_t i = 0; i < count; ++i) found[i] = condition(i) & kBit[i];
  std::uint32_t bits = 0;
  for (const std::uint32_t bit : found) bits |= bit;
  return bits;
}

}  // namespace deliso
