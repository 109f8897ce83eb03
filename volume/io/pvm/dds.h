// The differential data stream that packs PVM volumes.
#pragma once

#include <string>
#include <string_view>

#include "volume/io/base/byte_stream.h"

namespace deliso {

// The first lines of both versions.
inline constexpr std::string_view kDdsMagic = "DDS v3d\n";
inline constexpr std::string_view kDdsBlockMagic = "DDS v3e\n";

// Unpacks what follows the magic. Bytes are coded in runs: 7 bits for the length of a run (0 ends the data), 3 bits for
// the width of its numbers, then as many numbers: differences to the byte before or, behind the first row, to what the
// row before lets expect. The bytes of a sample lie apart: all first ones, then all second ones; within the whole, or
// (`is_blocked`) within blocks of 2^24 samples. Throws InputError when the data end early.
std::string unpack_dds(const ByteStream& file, std::string_view packed, bool is_blocked);

}  // namespace deliso
