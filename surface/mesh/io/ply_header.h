// The header of a PLY file: which elements follow, and how their properties are stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/mesh/io/text.h"

namespace deliso {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

enum class PlyRole { kSkipped, kX, kY, kZ, kCorners, kLabel };

struct PlyProperty {
  PlyType type = PlyType::kInt8;  // of the value, or of the members of the list
  bool is_list = false;
  PlyType count_type = PlyType::kInt8;  // of the length of the list
  PlyRole role = PlyRole::kSkipped;
};

struct PlyElement {
  std::int64_t count = 0;
  bool is_vertex = false;
  bool is_face = false;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
};

// Bytes of one value.
std::size_t ply_size_of(PlyType type);

// Leaves `in` behind the line end_header. Afterwards there is one element vertex with one x, y and z each, and every
// element face has one list of corners. Throws InputError otherwise.
PlyHeader parse_ply_header(TextScanner& in);

}  // namespace deliso
