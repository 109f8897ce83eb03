// Samples written as decimal numbers.
#pragma once

#include <string>

#include "volume/io/base/byte_stream.h"
#include "volume/sample_type.h"

namespace deliso {

// Reads `count` numbers parted by blanks, commas or line ends and gives them as the bytes of a raw file, in this
// machine's byte order: all that is said of raw samples holds for them then. Throws InputError, naming the number's
// place in the row of numbers, when one is none or does not fit the type, or there are fewer than `count`; or more,
// where nothing else may follow.
std::string bytes_of_numbers(ByteStream& stream, StoredType type, std::uint64_t count, bool may_go_on = false);

// Parses a whole word as a number; a leading plus sign is allowed. Integers do not round, doubles may be inf or nan.
bool parse_word(std::string_view word, double& value);
bool parse_word(std::string_view word, std::int64_t& value);

}  // namespace deliso
