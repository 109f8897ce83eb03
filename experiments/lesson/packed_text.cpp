#include "experiments/lesson/packed_text.h"

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

constexpr int kLevel = 9;

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view kSymbols = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = (group << 8) | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kSymbols[group >> (18 - 6 * k) & 63u];
  }
  return text;
}

std::string packed_text(std::string_view text) {
  const auto size = static_cast<uLong>(text.size());
  uLongf packed = compressBound(size);
  std::vector<Bytef> bytes(packed);
  const int status = compress2(bytes.data(), &packed, reinterpret_cast<const Bytef*>(text.data()), size, kLevel);
  DELISO_CHECK(status == Z_OK, "a text can be packed");
  bytes.resize(packed);
  return base64(bytes);
}

}  // namespace deliso
