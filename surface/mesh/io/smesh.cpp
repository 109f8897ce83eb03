// TetGen's .smesh: points, facets, a point in each hole, a point in each region. Numbers count from 0.
#include <string>
#include <vector>

#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/text.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/solids.h"

namespace deliso {

namespace {

void append_row(std::string& text, std::size_t number, const Vec3& p) {
  append_number(text, number);
  text += ' ';
  append_point(text, p);
}

void append_parts(std::string& text, const EnclosedParts& enclosed) {
  std::size_t holes = 0, regions = 0, missing = 0;
  std::string hole_rows, region_rows;
  for (const EnclosedPart& part : enclosed.parts) {
    if (!part.point) {
      ++missing;
      continue;
    }
    if (part.is_solid) {
      append_row(region_rows, regions++, *part.point);
      region_rows.back() = ' ';
      append_number(region_rows, std::uint64_t{part.component} + 1);  // the attribute of its tetrahedra
      region_rows += '\n';
    } else {
      append_row(hole_rows, holes++, *part.point);
    }
  }
  text += "# a point in each cavity\n" + std::to_string(holes) + "\n" + hole_rows;
  text += "# a point in each solid, and the number of its component\n" + std::to_string(regions) + "\n" + region_rows;
  if (missing > 0) text += "# components for which no inner point was found: " + std::to_string(missing) + "\n";
  if (enclosed.open_components > 0)
    text += "# components with a boundary, which enclose nothing: " + std::to_string(enclosed.open_components) + "\n";
}

}  // namespace

std::string smesh_bytes(const TriangleMesh& mesh, const MeshFileOptions& options) {
  const std::vector<std::int64_t> references = triangle_references(mesh, options.attributes);
  std::string text;
  for (const std::string& comment : options.comments) text += "# " + comment + "\n";
  text.reserve(64 * mesh.points.size() + 32 * mesh.triangles.size());
  text += std::to_string(mesh.points.size()) + " 3 0 0\n";
  for (std::size_t v = 0; v < mesh.points.size(); ++v) append_row(text, v, mesh.points[v]);
  text += std::to_string(mesh.triangles.size()) + " 1\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += '3';
    for (const std::uint32_t v : mesh.triangles[t]) {
      text += ' ';
      append_number(text, v);
    }
    text += ' ';
    append_number(text, references[t]);
    text += '\n';
  }
  append_parts(text, enclosed_parts(mesh, mesh_topology(mesh)));
  return text;
}

}  // namespace deliso
