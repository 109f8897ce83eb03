#include "surface/mesh/io/polygon_lists.h"

#include <cstddef>
#include <vector>

#include "surface/mesh/io/text.h"

namespace deliso {

namespace {

void append_strip(TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::size_t turned = i % 2;
    mesh.triangles.push_back({corners[i - 2 + turned], corners[i - 1 - turned], corners[i]});
  }
}

}  // namespace

void append_polygons(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, bool are_strips,
                     std::int64_t base, std::int64_t points, const FailExpecting& fail, TriangleMesh& mesh,
                     CellNumbers& cells) {
  std::int64_t begin = 0;
  std::size_t cell = cells.of_triangle.empty() ? 0 : cells.of_triangle.back() + 1;
  const std::size_t triangles_before = mesh.triangles.size() - cells.of_triangle.size();
  std::vector<std::uint32_t> polygon;
  for (const std::int64_t end : ends) {
    if (end < begin || end > static_cast<std::int64_t>(corners.size()))
      fail("ends of polygons from " + std::to_string(begin) + " to " + std::to_string(corners.size()), end);
    if (end - begin < 3) fail("a polygon with at least 3 corners", end - begin);
    polygon.clear();
    for (const std::int64_t v :
         corners.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin))) {
      if (v < 0 || v >= points) fail("an index below " + std::to_string(points), v);
      polygon.push_back(static_cast<std::uint32_t>(base + v));
    }
    begin = end;
    if (are_strips) {
      append_strip(mesh, polygon);
    } else {
      append_fan(mesh, polygon);
    }
    cells.of_triangle.resize(mesh.triangles.size() - triangles_before, cell++);
  }
}

void append_labels(const CellNumbers& cells, std::span<const double> labels, TriangleMesh& mesh) {
  mesh.labels.resize(mesh.triangles.size() - cells.of_triangle.size(), 0);
  for (const std::size_t number : cells.of_triangle) {
    const std::size_t cell = cells.before + number;
    mesh.labels.push_back(cell < labels.size() ? label_of_number(labels[cell]) : 0);
  }
}

}  // namespace deliso
