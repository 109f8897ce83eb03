// PLY (Turk): a header that declares elements and their properties, then the data as text or binary in either byte
// order. Reading takes x, y, z of `vertex`, the list vertex_indices (or vertex_index) of `face` and its label; all else
// is skipped.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/ply_header.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

constexpr const char* kEnd = "the end of the file after the last element";

// The values of a text body. What a value is used for decides how strictly it is read.
class TextValues {
 public:
  explicit TextValues(TextScanner in) : in_(std::move(in)) {}
  double number(PlyType, const char* what) { return in_.number(what); }
  std::int64_t integer(PlyType, const char* what) { return in_.integer(what, 0); }
  void skip(PlyType, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      if (in_.word().empty()) in_.fail("another value", "");
    }
  }
  void expect_end() {
    if (const std::string_view found = in_.word(); !found.empty()) in_.fail(kEnd, found);
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
  double number(PlyType type, const char* what) {
    double value = 0;
    if (type == PlyType::kDouble) {
      value = in_.read<double>(what);
    } else if (type == PlyType::kFloat) {
      value = static_cast<double>(in_.read<float>(what));
    } else {
      value = static_cast<double>(whole(type, what));
    }
    if (!std::isfinite(value)) in_.fail(std::string(what) + " (a finite number), found " + std::to_string(value));
    return value;
  }
  std::int64_t integer(PlyType type, const char* what) {
    const std::int64_t value = whole(type, what);
    if (value < 0) fail(what, value);
    return value;
  }
  void skip(PlyType type, std::int64_t count) {
    const std::size_t most = in_.remaining() / ply_size_of(type) + 1;  // more bytes cannot be skipped in any case
    in_.skip(std::min(static_cast<std::size_t>(count), most) * ply_size_of(type), "another value");
  }
  void expect_end() {
    if (in_.remaining() > 0) in_.fail(kEnd + (", found " + std::to_string(in_.remaining())) + " bytes more");
  }
  [[nodiscard]] std::size_t most_items(std::size_t bytes_each) const { return in_.remaining() / bytes_each; }
  [[noreturn]] void fail(const std::string& what, std::int64_t found) const {
    in_.fail(what + ", found " + std::to_string(found));
  }

 private:
  std::int64_t whole(PlyType type, const char* what) {
    switch (type) {
      case PlyType::kInt8:
        return in_.read<std::int8_t>(what);
      case PlyType::kUint8:
        return in_.read<std::uint8_t>(what);
      case PlyType::kInt16:
        return in_.read<std::int16_t>(what);
      case PlyType::kUint16:
        return in_.read<std::uint16_t>(what);
      case PlyType::kInt32:
        return in_.read<std::int32_t>(what);
      case PlyType::kUint32:
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
  BodyParser(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {
    for (const PlyElement& element : header.elements) {
      if (element.is_vertex) vertex_count_ = element.count;
    }
  }

  TriangleMesh parse() {
    for (const PlyElement& element : header_.elements) {
      // Reserve for what the header promises, but not more than the file can hold.
      const auto promised = static_cast<std::size_t>(element.count);
      if (element.is_vertex) mesh_.points.reserve(std::min(promised, values_.most_items(3)));
      if (element.is_face) mesh_.triangles.reserve(std::min(promised, values_.most_items(4)));
      if (element.properties.empty()) continue;
      for (std::int64_t i = 0; i < element.count; ++i) parse_item(element);
    }
    values_.expect_end();
    return std::move(mesh_);
  }

 private:
  void parse_item(const PlyElement& element) {
    Vec3 p;
    for (const PlyProperty& property : element.properties) {
      switch (property.role) {
        case PlyRole::kX:
          p.x = values_.number(property.type, "an x coordinate");
          break;
        case PlyRole::kY:
          p.y = values_.number(property.type, "a y coordinate");
          break;
        case PlyRole::kZ:
          p.z = values_.number(property.type, "a z coordinate");
          break;
        case PlyRole::kCorners:
          parse_face(property);
          break;
        case PlyRole::kLabel:
          label_ = values_.number(property.type, "a label");
          has_labels_ = true;
          break;
        case PlyRole::kSkipped:
          values_.skip(property.type,
                       property.is_list ? values_.integer(property.count_type, "the length of a list") : 1);
      }
    }
    if (element.is_vertex) mesh_.points.push_back(p);
    if (has_labels_) mesh_.labels.resize(mesh_.triangles.size(), label_of_number(label_));
  }

  void parse_face(const PlyProperty& property) {
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

  const PlyHeader& header_;
  Values values_;
  double label_ = 0;
  bool has_labels_ = false;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> polygon_;
  std::int64_t vertex_count_ = 0;
};

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh, bool ascii, const MeshComments& comments) {
  const std::string facing = "triangles are counterclockwise seen from the side of lower values";
  // Signed indices are what most readers expect; they do as long as they suffice.
  const bool is_small = mesh.points.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  std::string bytes =
      std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") + " 1.0\ncomment " + facing;
  for (const std::string& comment : comments) {
    if (comment != facing) bytes += "\ncomment " + comment;  // a mesh that was read has the line already
  }
  bytes += "\nelement vertex " + std::to_string(mesh.points.size()) +
           "\nproperty double x\nproperty double y\nproperty double z" + "\nelement face " +
           std::to_string(mesh.triangles.size()) + "\nproperty list uchar " + (is_small ? "int" : "uint") +
           " vertex_indices\n" + (mesh.labels.empty() ? "" : "property int label\n") + "end_header\n";
  if (ascii) {
    for (const Vec3& p : mesh.points) append_point(bytes, p);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      bytes += '3';
      for (const std::uint32_t v : mesh.triangles[t]) {
        bytes += ' ';
        append_number(bytes, v);
      }
      if (!mesh.labels.empty()) bytes += ' ' + std::to_string(mesh.labels[t]);
      bytes += '\n';
    }
    return bytes;
  }
  bytes.reserve(bytes.size() + 24 * mesh.points.size() + 13 * mesh.triangles.size() + 4 * mesh.labels.size());
  for (const Vec3& p : mesh.points) {
    for (const double c : {p.x, p.y, p.z}) append_little_endian(bytes, c);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bytes += '\3';
    for (const std::uint32_t v : mesh.triangles[t]) append_little_endian(bytes, v);
    if (!mesh.labels.empty()) append_little_endian(bytes, static_cast<std::uint32_t>(mesh.labels[t]));
  }
  return bytes;
}

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) {
  TextScanner in(bytes, file);
  const PlyHeader header = parse_ply_header(in);
  if (header.encoding == PlyEncoding::kAscii) return BodyParser<TextValues>(header, TextValues(in)).parse();
  const std::endian order = header.encoding == PlyEncoding::kLittleEndian ? std::endian::little : std::endian::big;
  return BodyParser<BinaryValues>(header, BinaryValues(ByteReader(bytes, file, order, in.position()))).parse();
}

}  // namespace deliso
