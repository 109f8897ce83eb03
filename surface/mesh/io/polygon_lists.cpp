#include "surface/mesh/io/polygon_lists.h"

#include <cstddef>
#include <vector>

#include "surface/mesh/io/text.h"

namespace deliso {

void append_polygons(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, bool are_strips,
                     std::int64_t base, std::int64_t points, const FailExpecting& fail, TriangleMesh& mesh) {
  std::int64_t begin = 0;
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
    if (!are_strips) {
      append_fan(mesh, polygon);
      continue;
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const std::size_t turned = i % 2;
      mesh.triangles.push_back({polygon[i - 2 + turned], polygon[i - 1 - turned], polygon[i]});
    }
  }
}

}  // namespace deliso
