// VTK's XML format for PolyData: the arrays as text, or appended as raw bytes in little-endian order.
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

// Writes the tags, and beside them what they refer to.
class VtpWriter {
 public:
  VtpWriter(const TriangleMesh& mesh, const MeshFileOptions& options) : mesh_(mesh), options_(options) {}

  std::string bytes() {
    tags_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n";
    write_comments();
    tags_ += "<Piece NumberOfPoints=\"" + std::to_string(mesh_.points.size()) +
             "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
             std::to_string(mesh_.triangles.size()) + "\">\n";
    write_attributes("PointData", options_.attributes.vertices);
    write_attributes("CellData", options_.attributes.triangles);
    write_points();
    write_triangles();
    tags_ += "</Piece>\n</PolyData>\n";
    if (!options_.ascii) tags_ += "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n";
    return std::move(tags_) + "</VTKFile>\n";
  }

 private:
  // Texts are the numbers of their letters, each text ended by a 0.
  void write_comments() {
    if (options_.comments.empty()) return;
    tags_ += "<FieldData>\n<DataArray type=\"String\" Name=\"comments\" NumberOfTuples=\"" +
             std::to_string(options_.comments.size()) + "\" format=\"ascii\">\n";
    for (const std::string& comment : options_.comments) {
      for (const char c : comment) tags_ += std::to_string(static_cast<unsigned char>(c)) + " ";
      tags_ += "0\n";
    }
    tags_ += "</DataArray>\n</FieldData>\n";
  }

  // An array of `count` numbers of a type; number(i) gives them.
  template <class Number, class NumberAt>
  void write_array(const std::string& name, const char* type, std::size_t width, std::size_t count,
                   const NumberAt& number) {
    tags_ += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
             std::to_string(width) + "\"";
    if (options_.ascii) {
      tags_ += " format=\"ascii\">\n";
      for (std::size_t i = 0; i < count; ++i) {
        append_number(tags_, static_cast<Number>(number(i)));
        tags_ += i % width + 1 == width ? '\n' : ' ';
      }
      tags_ += "</DataArray>\n";
      return;
    }
    tags_ += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    append_little_endian(appended_, std::uint64_t{count * sizeof(Number)});
    for (std::size_t i = 0; i < count; ++i) append_little_endian(appended_, static_cast<Number>(number(i)));
  }

  void write_attributes(const std::string& element, const std::vector<MeshAttribute>& attributes) {
    if (attributes.empty()) return;
    tags_ += "<" + element + ">\n";
    for (const MeshAttribute& attribute : attributes) {
      const auto number = [&](std::size_t i) { return attribute.values[i]; };
      const std::size_t count = attribute.values.size();
      if (attribute.is_whole) {
        write_array<std::int32_t>(attribute.name, "Int32", attribute.width, count, number);
      } else {
        write_array<double>(attribute.name, "Float64", attribute.width, count, number);
      }
    }
    tags_ += "</" + element + ">\n";
  }

  void write_points() {
    tags_ += "<Points>\n";
    write_array<double>("points", "Float64", 3, 3 * mesh_.points.size(),
                        [&](std::size_t i) { return mesh_.points[i / 3][i % 3]; });
    tags_ += "</Points>\n";
  }

  void write_triangles() {
    tags_ += "<Polys>\n";
    write_array<std::int64_t>("connectivity", "Int64", 1, 3 * mesh_.triangles.size(),
                              [&](std::size_t i) { return mesh_.triangles[i / 3][i % 3]; });
    write_array<std::int64_t>("offsets", "Int64", 1, mesh_.triangles.size(), [](std::size_t i) { return 3 * (i + 1); });
    tags_ += "</Polys>\n";
  }

  const TriangleMesh& mesh_;
  const MeshFileOptions& options_;
  std::string tags_, appended_;
};

}  // namespace

std::string vtp_bytes(const TriangleMesh& mesh, const MeshFileOptions& options) {
  return VtpWriter(mesh, options).bytes();
}

}  // namespace deliso
