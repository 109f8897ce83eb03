#include "volume/io/pvm/dds.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace deliso {

namespace {

// Numbers of some bits, the highest bit first.
class BitReader {
 public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool is_over() const { return position_ > 8 * bytes_.size(); }
  // Zeros behind the end.
  unsigned read(unsigned count) {
    unsigned value = 0;
    for (unsigned n = 0; n < count; ++n, ++position_) {
      const std::size_t byte = position_ / 8;
      const unsigned bit =
          byte < bytes_.size() ? static_cast<std::uint8_t>(bytes_[byte]) >> (7 - position_ % 8) & 1u : 0u;
      value = 2 * value + bit;
    }
    return value;
  }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;  // in bits
};

// Brings the bytes of each sample together, within a block.
void join_bytes(std::string& data, std::size_t first, std::size_t count, std::size_t per_sample) {
  const std::string apart = data.substr(first, count);
  std::size_t from = 0;
  for (std::size_t byte = 0; byte < per_sample; ++byte) {
    for (std::size_t to = byte; to < count; to += per_sample) data[first + to] = apart[from++];
  }
}

}  // namespace

std::string unpack_dds(const ByteStream& file, std::string_view packed, bool is_blocked) {
  constexpr unsigned kSampleBits = 2, kRowBits = 16, kRunBits = 7, kWidthBits = 3;
  constexpr std::size_t kBlockSamples = std::size_t{1} << 24;
  BitReader bits(packed);
  const std::size_t per_sample = bits.read(kSampleBits) + 1;
  const std::size_t row = bits.read(kRowBits) + 1;
  std::string data;
  unsigned value = 0;
  while (const unsigned run = bits.read(kRunBits)) {
    const unsigned code = bits.read(kWidthBits);
    const unsigned width = code == 0 ? 0 : code + 1;
    const unsigned middle = (1u << width) / 2;
    if (bits.is_over()) file.fail("the packed data end early: the file is cut off");
    for (unsigned n = 0; n < run; ++n) {
      const std::size_t at = data.size();
      // Arithmetic modulo 256, as the last conversion makes it.
      if (row > 1 && at > row)
        value += static_cast<std::uint8_t>(data[at - row]) - static_cast<std::uint8_t>(data[at - row - 1]);
      value += bits.read(width) - middle;
      data += static_cast<char>(value & 0xFFu);
    }
  }
  if (bits.is_over()) file.fail("the packed data end early: the file is cut off");
  if (per_sample == 1) return data;
  const std::size_t block = is_blocked ? kBlockSamples * per_sample : data.size();
  for (std::size_t first = 0; first < data.size(); first += block)
    join_bytes(data, first, std::min(block, data.size() - first), per_sample);
  return data;
}

}  // namespace deliso
