// PLY (Turk): a header that declares elements and their properties, then the data as text or binary in either byte
// order. Reading takes x, y, z of `vertex` and the list vertex_indices (or vertex_index) of `face`; all else is
// skipped.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "surface/mesh_io_bytes.h"
#include "surface/mesh_io_formats.h"
#include "surface/mesh_io_text.h"

namespace deliso {

namespace {

enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

enum class Role { kSkipped, kX, kY, kZ, kCorners };

struct Property {
  ScalarType type = ScalarType::kInt8;  // of the value, or of the members of the list
  bool is_list = false;
  ScalarType count_type = ScalarType::kInt8;  // of the length of the list
  Role role = Role::kSkipped;
};

struct Element {
  std::int64_t count = 0;
  bool is_vertex = false;
  bool is_face = false;
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
};

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::kInt8:
    case ScalarType::kUint8:
      return 1;
    case ScalarType::kInt16:
    case ScalarType::kUint16:
      return 2;
    case ScalarType::kInt32:
    case ScalarType::kUint32:
    case ScalarType::kFloat:
      return 4;
    case ScalarType::kDouble:
      return 8;
  }
  return 0;
}

ScalarType parse_type(TextScanner& in) {
  const std::string_view name = in.word_on_line();
  if (name == "char" || name == "int8") return ScalarType::kInt8;
  if (name == "uchar" || name == "uint8") return ScalarType::kUint8;
  if (name == "short" || name == "int16") return ScalarType::kInt16;
  if (name == "ushort" || name == "uint16") return ScalarType::kUint16;
  if (name == "int" || name == "int32") return ScalarType::kInt32;
  if (name == "uint" || name == "uint32") return ScalarType::kUint32;
  if (name == "float" || name == "float32") return ScalarType::kFloat;
  if (name == "double" || name == "float64") return ScalarType::kDouble;
  in.fail("a PLY type (char, uchar, short, ushort, int, uint, float or double)", name);
}

Property parse_property(TextScanner& in, const Element& element) {
  Property property;
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
    if (name == "x") property.role = Role::kX;
    if (name == "y") property.role = Role::kY;
    if (name == "z") property.role = Role::kZ;
  }
  if (element.is_face && property.is_list && (name == "vertex_indices" || name == "vertex_index")) {
    property.role = Role::kCorners;
  }
  return property;
}

Element parse_element(TextScanner& in) {
  Element element;
  const std::string_view name = in.word_on_line();
  element.is_vertex = name == "vertex";
  element.is_face = name == "face";
  element.count = in.integer("the number of elements", 0);
  if (element.is_vertex && element.count >= std::numeric_limits<std::uint32_t>::max()) {
    in.fail("fewer than 2^32 - 1 vertices", std::to_string(element.count));
  }
  return element;
}

void check_roles(const TextScanner& in, const Header& header) {
  std::int64_t vertex_elements = 0;
  for (const Element& element : header.elements) {
    std::array<int, 5> seen{};
    for (const Property& property : element.properties) ++seen[static_cast<std::size_t>(property.role)];
    if (element.is_vertex) {
      ++vertex_elements;
      if (seen[1] != 1 || seen[2] != 1 || seen[3] != 1) in.fail("vertices with one x, one y and one z each", "others");
    }
    if (element.is_face && seen[4] != 1) in.fail("faces with one list vertex_indices each", "others");
  }
  if (vertex_elements != 1) in.fail("one element vertex", std::to_string(vertex_elements));
}

// Leaves `in` behind the line end_header.
Header parse_header(TextScanner& in) {
  Header header;
  if (const std::string_view magic = in.word_on_line(); magic != "ply") in.fail("ply", magic);
  bool has_format = false;
  while (true) {
    if (!in.next_line()) in.fail("end_header", "");
    const std::string_view keyword = in.word_on_line();
    if (keyword == "format") {
      const std::string_view name = in.word_on_line();
      if (name == "ascii") {
        header.encoding = Encoding::kAscii;
      } else if (name == "binary_little_endian") {
        header.encoding = Encoding::kLittleEndian;
      } else if (name == "binary_big_endian") {
        header.encoding = Encoding::kBigEndian;
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

// The values of a text body. What a value is used for decides how strictly it is read.
class TextValues {
 public:
  explicit TextValues(TextScanner in) : in_(std::move(in)) {}
  double number(ScalarType, const char* what) { return in_.number(what); }
  std::int64_t integer(ScalarType, const char* what) { return in_.integer(what, 0); }
  void skip(ScalarType, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      if (in_.word().empty()) in_.fail("another value", "");
    }
  }
  [[nodiscard]] std::size_t most_items(std::size_t) const { return in_.remaining() / 2 + 1; }
  [[noreturn]] void fail(const std::string& what, std::int64_t found) const { in_.fail(what, std::to_string(found)); }

 private:
  TextScanner in_;
};

// The same for a binary body.
class BinaryValues {
 public:
  explicit BinaryValues(ByteReader in) : in_(std::move(in)) {}
  double number(ScalarType type, const char* what) {
    double value = 0;
    if (type == ScalarType::kDouble) {
      value = in_.read<double>(what);
    } else if (type == ScalarType::kFloat) {
      value = static_cast<double>(in_.read<float>(what));
    } else {
      value = static_cast<double>(whole(type, what));
    }
    if (!std::isfinite(value)) in_.fail(std::string(what) + " (a finite number), found " + std::to_string(value));
    return value;
  }
  std::int64_t integer(ScalarType type, const char* what) {
    const std::int64_t value = whole(type, what);
    if (value < 0) fail(what, value);
    return value;
  }
  void skip(ScalarType type, std::int64_t count) {
    const std::size_t most = in_.remaining() / size_of(type) + 1;  // more than that cannot be skipped anyway
    in_.skip(std::min(static_cast<std::size_t>(count), most) * size_of(type), "another value");
  }
  [[nodiscard]] std::size_t most_items(std::size_t bytes_each) const { return in_.remaining() / bytes_each; }
  [[noreturn]] void fail(const std::string& what, std::int64_t found) const {
    in_.fail(what + ", found " + std::to_string(found));
  }

 private:
  std::int64_t whole(ScalarType type, const char* what) {
    switch (type) {
      case ScalarType::kInt8:
        return in_.read<std::int8_t>(what);
      case ScalarType::kUint8:
        return in_.read<std::uint8_t>(what);
      case ScalarType::kInt16:
        return in_.read<std::int16_t>(what);
      case ScalarType::kUint16:
        return in_.read<std::uint16_t>(what);
      case ScalarType::kInt32:
        return in_.read<std::int32_t>(what);
      case ScalarType::kUint32:
        return in_.read<std::uint32_t>(what);
      default:
        in_.fail(std::string(what) + " of a whole type, found a floating one");
    }
  }

  ByteReader in_;
};

// Reads all elements in the order of the header. Faces may come before the vertices, whose number is known anyway.
template <class Values>
class BodyParser {
 public:
  BodyParser(const Header& header, Values values) : header_(header), values_(std::move(values)) {
    for (const Element& element : header.elements) {
      if (element.is_vertex) vertex_count_ = element.count;
    }
  }

  TriangleMesh parse() {
    for (const Element& element : header_.elements) {
      // Reserve for what the header promises, but not more than the file can hold.
      const auto promised = static_cast<std::size_t>(element.count);
      if (element.is_vertex) mesh_.points.reserve(std::min(promised, values_.most_items(3)));
      if (element.is_face) mesh_.triangles.reserve(std::min(promised, values_.most_items(4)));
      if (element.properties.empty()) continue;
      for (std::int64_t i = 0; i < element.count; ++i) parse_item(element);
    }
    return std::move(mesh_);
  }

 private:
  void parse_item(const Element& element) {
    Vec3 p;
    for (const Property& property : element.properties) {
      switch (property.role) {
        case Role::kX:
          p.x = values_.number(property.type, "an x coordinate");
          break;
        case Role::kY:
          p.y = values_.number(property.type, "a y coordinate");
          break;
        case Role::kZ:
          p.z = values_.number(property.type, "a z coordinate");
          break;
        case Role::kCorners:
          parse_face(property);
          break;
        case Role::kSkipped:
          values_.skip(property.type,
                       property.is_list ? values_.integer(property.count_type, "the length of a list") : 1);
      }
    }
    if (element.is_vertex) mesh_.points.push_back(p);
  }

  void parse_face(const Property& property) {
    const std::int64_t corners = values_.integer(property.count_type, "the number of corners");
    if (corners < 3) values_.fail("a face with at least 3 corners", corners);
    polygon_.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t v = values_.integer(property.type, "the index of a vertex");
      if (v >= vertex_count_) values_.fail("an index below " + std::to_string(vertex_count_), v);
      polygon_.push_back(static_cast<std::uint32_t>(v));
    }
    append_fan(mesh_, polygon_);
  }

  const Header& header_;
  Values values_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> polygon_;
  std::int64_t vertex_count_ = 0;
};

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh, bool ascii) {
  // Signed indices are what most readers expect; they do as long as they suffice.
  const bool is_small = mesh.points.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  std::string bytes = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") +
                      " 1.0\ncomment triangles are counterclockwise seen from the side of lower values" +
                      "\nelement vertex " + std::to_string(mesh.points.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z" + "\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar " + (is_small ? "int" : "uint") +
                      " vertex_indices\nend_header\n";
  if (ascii) {
    for (const Vec3& p : mesh.points) append_point(bytes, p);
    for (const auto& [a, b, c] : mesh.triangles) {
      bytes += '3';
      for (const std::uint32_t v : {a, b, c}) {
        bytes += ' ';
        append_number(bytes, v);
      }
      bytes += '\n';
    }
    return bytes;
  }
  bytes.reserve(bytes.size() + 24 * mesh.points.size() + 13 * mesh.triangles.size());
  for (const Vec3& p : mesh.points) {
    for (const double c : {p.x, p.y, p.z}) append_little_endian(bytes, c);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    bytes += '\3';
    for (const std::uint32_t v : {a, b, c}) append_little_endian(bytes, v);
  }
  return bytes;
}

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) {
  TextScanner in(bytes, file);
  const Header header = parse_header(in);
  if (header.encoding == Encoding::kAscii) return BodyParser<TextValues>(header, TextValues(in)).parse();
  const std::endian order = header.encoding == Encoding::kLittleEndian ? std::endian::little : std::endian::big;
  return BodyParser<BinaryValues>(header, BinaryValues(ByteReader(bytes, file, order, in.position()))).parse();
}

}  // namespace deliso
