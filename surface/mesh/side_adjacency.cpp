#include "surface/mesh/side_adjacency.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace deliso {

// Sides are put into buckets by their lower end vertex.
void set_side_adjacency(SurfaceMesh& mesh) {
  const auto ends = [&](TriangleSide side) {
    const auto& v = mesh.triangles[side >> 2];
    return std::minmax(v[((side & 3u) + 1) % 3], v[((side & 3u) + 2) % 3]);
  };
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) visit(4 * t + i);
    }
  };
  std::vector<std::uint32_t> first(mesh.points.size() + 2, 0);  // where each bucket begins, advanced as it is filled
  for_each_side([&](TriangleSide side) { ++first[ends(side).first + 2]; });
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<TriangleSide> sides(3 * mesh.triangles.size());
  for_each_side([&](TriangleSide side) { sides[first[ends(side).first + 1]++] = side; });
  mesh.neighbours.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  std::vector<std::pair<std::uint32_t, TriangleSide>> bucket;  // (higher end, side)
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    bucket.clear();
    for (std::size_t i = first[v]; i < first[v + 1]; ++i) bucket.emplace_back(ends(sides[i]).second, sides[i]);
    std::sort(bucket.begin(), bucket.end());
    for (std::size_t i = 1; i < bucket.size(); ++i) {
      const auto& [a_high, a] = bucket[i - 1];
      const auto& [b_high, b] = bucket[i];
      if (a_high != b_high) continue;
      mesh.neighbours[a >> 2][a & 3u] = b;
      mesh.neighbours[b >> 2][b & 3u] = a;
    }
  }
}

}  // namespace deliso
