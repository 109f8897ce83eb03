#include "surface/mesh/io/ply_header.h"

#include <array>
#include <limits>
#include <string>

namespace deliso {

namespace {

PlyType parse_type(TextScanner& in) {
  const std::string_view name = in.word_on_line();
  if (name == "char" || name == "int8") return PlyType::kInt8;
  if (name == "uchar" || name == "uint8") return PlyType::kUint8;
  if (name == "short" || name == "int16") return PlyType::kInt16;
  if (name == "ushort" || name == "uint16") return PlyType::kUint16;
  if (name == "int" || name == "int32") return PlyType::kInt32;
  if (name == "uint" || name == "uint32") return PlyType::kUint32;
  if (name == "float" || name == "float32") return PlyType::kFloat;
  if (name == "double" || name == "float64") return PlyType::kDouble;
  in.fail("a PLY type (char, uchar, short, ushort, int, uint, float or double)", name);
}

PlyProperty parse_property(TextScanner& in, const PlyElement& element) {
  PlyProperty property;
  TextScanner ahead = in;
  property.is_list = ahead.word_on_line() == "list";
  if (property.is_list) {
    in = ahead;
    property.count_type = parse_type(in);
  }
  property.type = parse_type(in);
  const std::string_view name = in.word_on_line();
  if (name.empty()) in.fail("the name of a property", name);
  if (element.is_vertex && !property.is_list) {
    if (name == "x") property.role = PlyRole::kX;
    if (name == "y") property.role = PlyRole::kY;
    if (name == "z") property.role = PlyRole::kZ;
  }
  if (element.is_face && property.is_list && (name == "vertex_indices" || name == "vertex_index")) {
    property.role = PlyRole::kCorners;
  }
  if (element.is_face && !property.is_list && name == "label") property.role = PlyRole::kLabel;
  return property;
}

PlyElement parse_element(TextScanner& in) {
  PlyElement element;
  const std::string_view name = in.word_on_line();
  element.is_vertex = name == "vertex";
  element.is_face = name == "face";
  element.count = in.integer("the number of elements", 0);
  if (element.is_vertex && element.count >= std::numeric_limits<std::uint32_t>::max()) {
    in.fail("fewer than 2^32 - 1 vertices", std::to_string(element.count));
  }
  return element;
}

void check_roles(const TextScanner& in, const PlyHeader& header) {
  std::int64_t vertex_elements = 0;
  for (const PlyElement& element : header.elements) {
    std::array<int, 6> seen{};
    for (const PlyProperty& property : element.properties) ++seen[static_cast<std::size_t>(property.role)];
    if (element.is_vertex) {
      ++vertex_elements;
      if (seen[1] != 1 || seen[2] != 1 || seen[3] != 1) in.fail("vertices with one x, one y and one z each", "others");
    }
    if (element.is_face && seen[4] != 1) in.fail("faces with one list vertex_indices each", "others");
  }
  if (vertex_elements != 1) in.fail("one element vertex", std::to_string(vertex_elements));
}

}  // namespace

std::size_t ply_size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      return 8;
  }
  return 0;
}

PlyHeader parse_ply_header(TextScanner& in) {
  PlyHeader header;
  if (const std::string_view magic = in.word_on_line(); magic != "ply") in.fail("ply", magic);
  bool has_format = false;
  while (true) {
    if (!in.next_line()) in.fail("end_header", "");
    const std::string_view keyword = in.word_on_line();
    if (keyword == "format") {
      const std::string_view name = in.word_on_line();
      if (name == "ascii") {
        header.encoding = PlyEncoding::kAscii;
      } else if (name == "binary_little_endian") {
        header.encoding = PlyEncoding::kLittleEndian;
      } else if (name == "binary_big_endian") {
        header.encoding = PlyEncoding::kBigEndian;
      } else {
        in.fail("ascii, binary_little_endian or binary_big_endian", name);
      }
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(in));
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail("an element before its properties", keyword);
      header.elements.back().properties.push_back(parse_property(in, header.elements.back()));
    } else if (keyword == "end_header") {
      break;
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      in.fail("a PLY keyword (format, element, property, comment, obj_info or end_header)", keyword);
    }
  }
  if (!has_format) in.fail("a line 'format' before end_header", "");
  check_roles(in, header);
  if (!in.next_line()) in.fail("a line feed behind end_header", "");
  return header;
}

}  // namespace deliso
