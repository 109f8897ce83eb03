// Numbers of any of VTK's types, as doubles.
#pragma once

#include "surface/mesh/io/bytes.h"
#include "volume/sample_type.h"

namespace deliso {

// The next number. Integers beyond 2^53 are rounded.
inline double number_of_type(ByteReader& in, StoredType type) {
  constexpr const char* kWhat = "another number";
  switch (type) {
    case StoredType::kU8:
    case StoredType::kBool:
      return in.read<std::uint8_t>(kWhat);
    case StoredType::kI8:
      return in.read<std::int8_t>(kWhat);
    case StoredType::kU16:
      return in.read<std::uint16_t>(kWhat);
    case StoredType::kI16:
    case StoredType::kF16:
      return in.read<std::int16_t>(kWhat);
    case StoredType::kU32:
      return in.read<std::uint32_t>(kWhat);
    case StoredType::kI32:
      return in.read<std::int32_t>(kWhat);
    case StoredType::kU64:
      return static_cast<double>(in.read<std::uint64_t>(kWhat));
    case StoredType::kI64:
      return static_cast<double>(in.read<std::int64_t>(kWhat));
    case StoredType::kF32:
      return static_cast<double>(in.read<float>(kWhat));
    case StoredType::kF64:
      break;
  }
  return in.read<double>(kWhat);
}

}  // namespace deliso
