// The step of SHA-256 (FIPS 180-4, section 6.2.2) that takes most of its time: one block of the message.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace deliso {

// The intermediate hash: a to h.
using Sha256State = std::array<std::uint32_t, 8>;

// Takes a block of 64 bytes into the state. By instructions for SHA-256 where the processor has them.
void compress(Sha256State& state, const std::byte* block);
// The same as the standard has it.
void compress_plainly(Sha256State& state, const std::byte* block);

}  // namespace deliso
