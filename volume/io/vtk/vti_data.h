// How VTK's XML files store the bytes of an array: in the text or behind it, raw or as base64, packed or not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "volume/io/base/byte_stream.h"
#include "volume/sample_type.h"

namespace deliso {

struct VtiEncoding {
  Endian endian = Endian::kLittle;
  bool has_wide_headers = false;  // numbers before the data have 64 bits, not 32
  bool is_packed = false;         // zlib, in blocks
};

// The bytes that `text` stands for; blanks are gone over, groups of four may end in = anywhere. At most `most` bytes.
std::string bytes_of_base64(const ByteStream& file, std::string_view text, std::uint64_t most);

// The data of an array of `count` bytes whose headers and data begin at the front of `bytes`.
std::string vti_data(const ByteStream& file, std::string_view bytes, const VtiEncoding& encoding, std::uint64_t count);

// The same in base64.
std::string vti_data_of_base64(const ByteStream& file, std::string_view text, const VtiEncoding& encoding,
                               std::uint64_t count);

}  // namespace deliso
