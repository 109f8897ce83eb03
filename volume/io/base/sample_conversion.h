// Stored values that are none of the types of Samples become one of them, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "delaunay/base/huge_pages.h"
#include "volume/io/base/byte_stream.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A half of IEEE 754 (binary16) as a float. Exact.
float float_of_half(std::uint16_t bits);

// i32 when all values fit, else doubles. Throws InputError naming the first voxel whose value no double holds, in the
// order x, y, z also where the values lie z fastest.
Samples narrowed(const LargeArray<std::uint32_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file);
Samples narrowed(const LargeArray<std::uint64_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file);
Samples narrowed(const LargeArray<std::int64_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file);

// The same of values that came from no file. Precondition: a double holds each.
Samples narrowed(const LargeArray<std::uint32_t>& values);
Samples narrowed(const LargeArray<std::uint64_t>& values);
Samples narrowed(const LargeArray<std::int64_t>& values);
// The first value that no double holds; nothing: there is none.
std::optional<std::size_t> first_without_double(const LargeArray<std::uint32_t>& values);
std::optional<std::size_t> first_without_double(const LargeArray<std::uint64_t>& values);
std::optional<std::size_t> first_without_double(const LargeArray<std::int64_t>& values);

// factor * sample + offset, as doubles.
Samples rescaled(const Samples& samples, double factor, double offset);

// The samples with axes x and z exchanged: from z fastest to x fastest. `dims` are those of the result.
Samples transposed(const Samples& samples, const Dims& dims);

// The samples in reverse order along the axes that are marked.
Samples flipped(const Samples& samples, const Dims& dims, const std::array<bool, 3>& axes);

}  // namespace deliso
