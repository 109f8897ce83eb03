// OFF (Geomview): counts, points, polygons. The variants COFF, NOFF, STOFF and their mixtures carry more numbers behind
// each point, which are skipped; so are colours behind polygons.
#include <algorithm>
#include <limits>
#include <vector>

#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"

namespace deliso {

std::string off_bytes(const TriangleMesh& mesh, const MeshComments& comments) {
  std::string text = "OFF\n";
  text.reserve(64 * mesh.points.size() + 24 * mesh.triangles.size());
  append_number(text, mesh.points.size());
  text += ' ';
  append_number(text, mesh.triangles.size());
  text += " 0\n";
  for (const Vec3& p : mesh.points) append_point(text, p);
  for (const auto& triangle : mesh.triangles) {
    text += '3';
    for (const std::uint32_t v : triangle) {
      text += ' ';
      append_number(text, v);
    }
    text += '\n';
  }
  // Last, because readers such as TetGen's expect the counts in the second line.
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  return text;
}

TriangleMesh parse_off(std::string_view bytes, const std::string& file) {
  TextScanner in(bytes, file, '#');
  const std::string_view keyword = in.word();
  const bool known = keyword == "OFF" || keyword == "COFF" || keyword == "NOFF" || keyword == "CNOFF" ||
                     keyword == "STOFF" || keyword == "STCOFF" || keyword == "STNOFF" || keyword == "STCNOFF";
  if (!known) in.fail("the keyword OFF", keyword);

  const std::int64_t point_count = in.integer("the number of points", 0);
  const std::int64_t polygon_count = in.integer("the number of polygons", 0);
  in.integer("the number of edges");
  if (point_count >= std::numeric_limits<std::uint32_t>::max()) {
    in.fail("fewer than 2^32 - 1 points", std::to_string(point_count));
  }

  // Reserve no more than the file can hold: a point takes at least six bytes and a polygon eight.
  TriangleMesh mesh;
  mesh.points.reserve(std::min(static_cast<std::size_t>(point_count), in.remaining() / 6));
  mesh.triangles.reserve(std::min(static_cast<std::size_t>(polygon_count), in.remaining() / 8));
  for (std::int64_t i = 0; i < point_count; ++i) {
    mesh.points.push_back(in.point());
    if (keyword != "OFF") in.next_line();
  }
  std::vector<std::uint32_t> polygon;
  for (std::int64_t i = 0; i < polygon_count; ++i) {
    const std::int64_t corners = in.integer("a polygon with at least 3 corners", 3);
    polygon.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t v = in.integer("the index of a point", 0);
      if (v >= point_count) in.fail("an index below " + std::to_string(point_count), std::to_string(v));
      polygon.push_back(static_cast<std::uint32_t>(v));
    }
    append_fan(mesh, polygon);
    in.next_line();
  }
  return mesh;
}

}  // namespace deliso
