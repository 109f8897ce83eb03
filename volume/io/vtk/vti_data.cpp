#include "volume/io/vtk/vti_data.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "volume/io/base/gzip_stream.h"

namespace deliso {

namespace {

// The value of a digit of base64, or -1.
int digit_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// A number of the header before the data, which is number n.
std::uint64_t header_number(const ByteStream& file, std::string_view bytes, const VtiEncoding& encoding,
                            std::uint64_t n) {
  const std::size_t size = encoding.has_wide_headers ? 8 : 4;
  if (n >= bytes.size() / size) file.fail("the data of the array end within their header: the file is cut off");
  std::uint64_t value = 0;
  for (std::size_t b = 0; b < size; ++b) {
    const std::size_t place = encoding.endian == Endian::kBig ? b : size - 1 - b;
    value = value << 8 | static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(n) * size + place]);
  }
  return value;
}

[[noreturn]] void fail_size(const ByteStream& file, std::uint64_t found, std::uint64_t count) {
  file.fail("the array has " + std::to_string(found) + " bytes, but the extent, the type and the components need " +
            std::to_string(count));
}

// Numbers before packed data: of blocks, the bytes of each block, of the last one (0: as the others), then the packed
// bytes of each.
std::string unpacked_blocks(const ByteStream& file, std::string_view bytes, const VtiEncoding& encoding,
                            std::uint64_t count) {
  constexpr std::uint64_t kBefore = 3;
  const std::uint64_t blocks = header_number(file, bytes, encoding, 0);
  const std::uint64_t size = header_number(file, bytes, encoding, 1);
  const std::uint64_t last = header_number(file, bytes, encoding, 2);
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (blocks == 0 || blocks > bytes.size() || size > kMost || last > size)
    file.fail("the header of the packed array has " + std::to_string(blocks) + " blocks of " + std::to_string(size) +
              " bytes, which cannot be");
  const std::uint64_t whole = last == 0 ? blocks * size : (blocks - 1) * size + last;
  if (whole != count) fail_size(file, whole, count);
  std::uint64_t at = (kBefore + blocks) * (encoding.has_wide_headers ? 8 : 4);
  std::string out;
  for (std::uint64_t n = 0; n < blocks; ++n) {
    const std::uint64_t packed = header_number(file, bytes, encoding, kBefore + n);
    if (at > bytes.size() || packed > bytes.size() - at)
      file.fail("the packed data of the array end early: the file is cut off");
    MemoryStream block(file, std::string(bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(packed))));
    GzipReader zlib(block);
    const std::uint64_t wanted = n + 1 == blocks ? count - out.size() : size;
    const auto found = zlib.take(wanted, "a block of the packed array");
    out.append(reinterpret_cast<const char*>(found.data()), found.size());
    at += packed;
  }
  return out;
}

}  // namespace

std::string bytes_of_base64(const ByteStream& file, std::string_view text, std::uint64_t most) {
  std::string out;
  std::array<int, 4> group{};
  std::size_t filled = 0, padding = 0;
  for (const char c : text) {
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const int digit = c == '=' ? 0 : digit_of(c);
    if (c == '=') ++padding;
    if (digit < 0 || (padding > 0 && c != '=') || padding > 2)
      file.fail("the data have the character " + in_quotes({&c, 1}) + ", expected base64");
    group.at(filled++) = digit;
    if (filled < 4) continue;
    const auto bits = static_cast<unsigned>(((group[0] * 64 + group[1]) * 64 + group[2]) * 64 + group[3]);
    for (std::size_t b = 0; b < 3 - padding; ++b) out += static_cast<char>(bits >> (16 - 8 * b) & 0xFFu);
    filled = padding = 0;
    if (out.size() >= most) break;
  }
  return out;
}

std::string vti_data(const ByteStream& file, std::string_view bytes, const VtiEncoding& encoding, std::uint64_t count) {
  if (encoding.is_packed) return unpacked_blocks(file, bytes, encoding, count);
  const std::uint64_t size = header_number(file, bytes, encoding, 0);
  if (size != count) fail_size(file, size, count);
  const std::size_t start = encoding.has_wide_headers ? 8 : 4;
  if (count > bytes.size() - start)
    file.fail("the data of the array end after " + std::to_string(bytes.size() - start) + " bytes of " +
              std::to_string(count) + ": the file is cut off");
  return std::string(bytes.substr(start, static_cast<std::size_t>(count)));
}

std::string vti_data_of_base64(const ByteStream& file, std::string_view text, const VtiEncoding& encoding,
                               std::uint64_t count) {
  // Unpacked data end where their header says; what follows may belong to another array.
  const std::uint64_t most = encoding.is_packed ? text.size() : count + 8;
  return vti_data(file, bytes_of_base64(file, text, most), encoding, count);
}

}  // namespace deliso
