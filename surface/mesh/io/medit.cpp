// Medit's .mesh (INRIA): a keyword, a count, and the rows. Numbers count from 1; the last of a row is a reference.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

// Words of a row behind each keyword that is skipped, its reference included.
constexpr std::array<std::pair<std::string_view, int>, 28> kSkippedRows = {{
    {"Edges", 3},
    {"Tetrahedra", 5},
    {"Hexahedra", 9},
    {"Hexaedra", 9},
    {"Prisms", 7},
    {"Pyramids", 6},
    {"Corners", 1},
    {"Ridges", 1},
    {"RequiredVertices", 1},
    {"RequiredEdges", 1},
    {"RequiredTriangles", 1},
    {"RequiredQuadrilaterals", 1},
    {"Normals", 3},
    {"Tangents", 3},
    {"NormalAtVertices", 2},
    {"TangentAtVertices", 2},
    {"NormalAtTriangleVertices", 3},
    {"NormalAtQuadrilateralVertices", 3},
    {"TangentAtEdges", 3},
    {"SubDomainFromMesh", 4},
    {"SubDomainFromGeom", 4},
    {"EdgeOnGeometricEdge", 2},
    {"VertexOnGeometricVertex", 2},
    {"VertexOnGeometricEdge", 3},
    {"TriangleOnGeometricTriangle", 2},
    {"QuadrilateralOnGeometricQuadrilateral", 2},
    {"ParallelogramOnGeometricParallelogram", 2},
    {"VertexOnGeometricTriangle", 4},
}};

class MeditParser {
 public:
  MeditParser(std::string_view bytes, const std::string& file) : in_(bytes, file, '#') {}

  TriangleMesh parse() {
    if (const std::string_view first = in_.word(); first != "MeshVersionFormatted")
      in_.fail("the keyword MeshVersionFormatted", first);
    if (const std::int64_t version = in_.integer("the version 1, 2, 3 or 4", 1); version > 4)
      in_.fail("the version 1, 2, 3 or 4", std::to_string(version));
    for (std::string_view keyword = in_.word(); !keyword.empty() && keyword != "End"; keyword = in_.word())
      parse_section(keyword);
    if (!has_vertices_) in_.fail("the keyword Vertices", "");
    if (largest_ > static_cast<std::int64_t>(mesh_.points.size()))
      in_.fail("numbers of vertices of at most " + std::to_string(mesh_.points.size()), std::to_string(largest_));
    return std::move(mesh_);
  }

 private:
  void parse_section(std::string_view keyword) {
    if (keyword == "Dimension") {
      if (const std::int64_t dimension = in_.integer("the dimension 3"); dimension != 3)
        in_.fail("the dimension 3", std::to_string(dimension));
    } else if (keyword == "Vertices") {
      parse_vertices();
    } else if (keyword == "Triangles") {
      parse_polygons(3);
    } else if (keyword == "Quadrilaterals") {
      parse_polygons(4);
    } else if (keyword == "AngleOfCornerBound" || keyword == "Identifier" || keyword == "Geometry") {
      if (in_.word().empty()) in_.fail("a value", "");
    } else {
      skip_rows(keyword);
    }
  }

  void parse_vertices() {
    if (has_vertices_) in_.fail("the keyword Vertices once", "Vertices");
    has_vertices_ = true;
    const std::int64_t count = in_.integer("the number of vertices", 0);
    if (count >= std::numeric_limits<std::uint32_t>::max())
      in_.fail("fewer than 2^32 - 1 vertices", std::to_string(count));
    // No more than the file can hold: a row takes at least eight bytes.
    mesh_.points.reserve(std::min(static_cast<std::size_t>(count), in_.remaining() / 8));
    for (std::int64_t i = 0; i < count; ++i) {
      mesh_.points.push_back(in_.point());
      in_.number("the reference of a vertex");
    }
  }

  void parse_polygons(std::size_t corners) {
    const std::int64_t count = in_.integer("the number of triangles or quadrilaterals", 0);
    for (std::int64_t i = 0; i < count; ++i) {
      polygon_.clear();
      for (std::size_t k = 0; k < corners; ++k) {
        const std::int64_t v = in_.integer("the number of a vertex, from 1 on", 1);
        if (v >= std::numeric_limits<std::uint32_t>::max()) in_.fail("the number of a vertex", std::to_string(v));
        largest_ = std::max(largest_, v);
        polygon_.push_back(static_cast<std::uint32_t>(v - 1));
      }
      const double reference = in_.number("the reference of a triangle");
      append_fan(mesh_, polygon_);
      mesh_.labels.resize(mesh_.triangles.size(), label_of_number(reference));
    }
  }

  void skip_rows(std::string_view keyword) {
    const auto is_it = [&](const auto& row) { return row.first == keyword; };
    const auto known = std::find_if(kSkippedRows.begin(), kSkippedRows.end(), is_it);
    if (known == kSkippedRows.end()) in_.fail("a keyword of the Medit format (Vertices, Triangles, ..., End)", keyword);
    const std::int64_t count = in_.integer("the number of rows", 0);
    for (std::int64_t i = 0; i < count; ++i) {
      for (int k = 0; k < known->second; ++k) in_.number("a number of a row that is skipped");
    }
  }

  TextScanner in_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> polygon_;
  std::int64_t largest_ = 0;
  bool has_vertices_ = false;
};

}  // namespace

std::string medit_bytes(const TriangleMesh& mesh, const MeshFileOptions& options) {
  const std::vector<std::int64_t> references = triangle_references(mesh, options.attributes);
  std::vector<std::int64_t> of_vertex(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) of_vertex[v] = references[t];
  }
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n";  // 2: double precision
  text.reserve(64 * mesh.points.size() + 32 * mesh.triangles.size());
  append_number(text, mesh.points.size());
  text += '\n';
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    append_point(text, mesh.points[v]);
    text.back() = ' ';
    append_number(text, of_vertex[v]);
    text += '\n';
  }
  text += "Triangles\n";
  append_number(text, mesh.triangles.size());
  text += '\n';
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      append_number(text, std::uint64_t{v} + 1);
      text += ' ';
    }
    append_number(text, references[t]);
    text += '\n';
  }
  // Last, because not every reader knows comments.
  text += "End\n";
  for (const std::string& comment : options.comments) text += "# " + comment + "\n";
  return text;
}

TriangleMesh parse_medit(std::string_view bytes, const std::string& file) { return MeditParser(bytes, file).parse(); }

}  // namespace deliso
