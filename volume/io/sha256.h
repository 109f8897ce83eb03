// SHA-256 (FIPS 180-4), to tell volumes apart by their samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "volume/io/sha256_compression.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The hash of a message that comes in pieces.
class Sha256 {
 public:
  void update(std::span<const std::byte> bytes);
  // The hash of all bytes so far as 64 lower-case hexadecimal digits. Call it once, last.
  std::string finish();

 private:
  void absorb(const std::byte* block);

  Sha256State state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> block_{};
  std::size_t filled_ = 0;    // bytes waiting in block_
  std::uint64_t length_ = 0;  // bytes so far
};

// The hash of a volume's samples: their raw bytes, little endian, x fastest, in the order in which they lie in memory
// (reversed along axes that run backwards in the file). Dimensions and spacing have no part in it.
std::string sample_sha256(const Samples& samples);
std::string sample_sha256(const ScalarGrid& grid);

}  // namespace deliso
