#include "volume/io/sha256.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "volume/io/sha256_compression.h"
#include "volume/sample_type.h"

namespace deliso {

void Sha256::absorb(const std::byte* block) { compress(state_, block); }

void Sha256::update(std::span<const std::byte> bytes) {
  length_ += bytes.size();
  while (!bytes.empty()) {
    // Whole blocks are taken where they lie; pieces of one are gathered.
    if (filled_ == 0 && bytes.size() >= block_.size()) {
      absorb(bytes.data());
      bytes = bytes.subspan(block_.size());
      continue;
    }
    const std::size_t taken = std::min(bytes.size(), block_.size() - filled_);
    std::copy_n(bytes.begin(), taken, block_.data() + filled_);
    bytes = bytes.subspan(taken);
    filled_ += taken;
    if (filled_ == block_.size()) {
      absorb(block_.data());
      filled_ = 0;
    }
  }
}

std::string Sha256::finish() {
  // Pad with a one bit, zeros and the length in bits (section 5.1.1).
  const std::uint64_t bits = length_ * 8;
  const std::size_t zeros = (block_.size() + 55 - filled_) % block_.size();
  std::vector<std::byte> padding(1 + zeros + 8);
  padding[0] = std::byte{0x80};
  for (std::size_t n = 0; n < 8; ++n) padding[1 + zeros + n] = static_cast<std::byte>(bits >> (56 - 8 * n));
  update(padding);
  std::string hex;
  for (const std::uint32_t word : state_)
    for (int shift = 28; shift >= 0; shift -= 4) hex += "0123456789abcdef"[word >> shift & 0xF];
  return hex;
}

std::string sample_sha256(const Samples& samples) {
  Sha256 hash;
  const Samples in_order = little_endian(samples);
  hash.update(sample_bytes(in_order));
  return hash.finish();
}

std::string sample_sha256(const ScalarGrid& grid) { return sample_sha256(grid.samples()); }

}  // namespace deliso
