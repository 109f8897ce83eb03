// VTK's legacy format: PolyData as text or as big-endian binary data, with values of points (vertices) and of cells
// (triangles), and the comments as a field of texts.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "delaunay/base/check.h"
#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

// A text of a field as a line: what is no plain letter goes as %XX.
std::string percent_encoded(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    if (c > ' ' && c < '\x7F' && c != '%' && c != '"') {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kDigits[byte >> 4];
    out += kDigits[byte & 15u];
  }
  return out;
}

// The length of a text in front of it: its two highest bits say of how many bytes it is.
void append_text_length(std::string& bytes, std::size_t length) {
  constexpr std::size_t kOneByte = 1u << 6, kTwoBytes = 1u << 14;
  if (length < kOneByte) {
    append_big_endian(bytes, static_cast<std::uint8_t>(0xC0u | length));
  } else if (length < kTwoBytes) {
    append_big_endian(bytes, static_cast<std::uint16_t>(0x8000u | length));
  } else {
    append_big_endian(bytes, static_cast<std::uint32_t>(0x40000000u | length));
  }
}

void append_vtk_comments(std::string& bytes, const MeshComments& comments, bool ascii) {
  if (comments.empty()) return;
  bytes += "FIELD FieldData 1\ncomments 1 " + std::to_string(comments.size()) + " string\n";
  for (const std::string& comment : comments) {
    if (!ascii) append_text_length(bytes, comment.size());
    bytes += ascii ? percent_encoded(comment) + "\n" : comment;
  }
  if (!ascii) bytes += '\n';
}

void append_vtk_values(std::string& bytes, const MeshAttribute& attribute, bool ascii) {
  std::size_t in_row = 0;
  for (const double value : attribute.values) {
    if (!ascii) {
      attribute.is_whole ? append_big_endian(bytes, static_cast<std::int32_t>(value)) : append_big_endian(bytes, value);
      continue;
    }
    attribute.is_whole ? append_number(bytes, static_cast<std::int32_t>(value)) : append_number(bytes, value);
    bytes += ++in_row % attribute.width == 0 ? '\n' : ' ';
  }
  if (!ascii) bytes += '\n';
}

// As a field, of which readers take all arrays; of SCALARS many take the first.
void append_vtk_attributes(std::string& bytes, const char* keyword, std::size_t count,
                           const std::vector<MeshAttribute>& attributes, bool ascii) {
  if (attributes.empty()) return;
  bytes += keyword + std::to_string(count) + "\nFIELD attributes " + std::to_string(attributes.size()) + "\n";
  for (const MeshAttribute& attribute : attributes) {
    bytes += attribute.name + " " + std::to_string(attribute.width) + " " + std::to_string(count) +
             (attribute.is_whole ? " int\n" : " double\n");
    append_vtk_values(bytes, attribute, ascii);
  }
}

}  // namespace

std::string legacy_vtk_bytes(const TriangleMesh& mesh, const MeshFileOptions& options) {
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (mesh.points.size() > kMost || mesh.triangles.size() > kMost / 4)
    throw InputError("the legacy format of VTK holds numbers up to 2^31 - 1, the mesh has " +
                     std::to_string(mesh.triangles.size()) + " triangles: write .vtp");
  std::string bytes = "# vtk DataFile Version 3.0\n";
  bytes += options.comments.empty() ? "DelIso" : options.comments.front().substr(0, 255);
  bytes += options.ascii ? "\nASCII\n" : "\nBINARY\n";
  bytes += "DATASET POLYDATA\n";
  bytes.reserve(bytes.size() + 80 * mesh.points.size() + 40 * mesh.triangles.size());
  bytes += "POINTS " + std::to_string(mesh.points.size()) + " double\n";
  for (const Vec3& p : mesh.points) {
    if (options.ascii) append_point(bytes, p);
    for (const double c : {p.x, p.y, p.z}) {
      if (!options.ascii) append_big_endian(bytes, c);
    }
  }
  bytes += (options.ascii ? "POLYGONS " : "\nPOLYGONS ") + std::to_string(mesh.triangles.size()) + " " +
           std::to_string(4 * mesh.triangles.size()) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const std::uint32_t number : {std::uint32_t{3}, a, b, c}) {
      if (!options.ascii) append_big_endian(bytes, number);
      if (options.ascii) append_number(bytes, number);
      if (options.ascii) bytes += ' ';
    }
    if (options.ascii) bytes.back() = '\n';
  }
  if (!options.ascii) bytes += '\n';
  // Behind the triangles, because Gmsh expects the points first.
  append_vtk_comments(bytes, options.comments, options.ascii);
  append_vtk_attributes(bytes, "POINT_DATA ", mesh.points.size(), options.attributes.vertices, options.ascii);
  append_vtk_attributes(bytes, "CELL_DATA ", mesh.triangles.size(), options.attributes.triangles, options.ascii);
  return bytes;
}

}  // namespace deliso
