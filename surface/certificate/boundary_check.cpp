#include "surface/certificate/boundary_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace deliso {

namespace {

// The faces of the box that p lies on, as bits.
unsigned faces_with(const Vec3& p, const Box3& box, double on_box) {
  unsigned faces = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis] - box.low[axis]) <= on_box) faces |= 1u << (2 * axis);
    if (std::abs(p[axis] - box.high[axis]) <= on_box) faces |= 2u << (2 * axis);
  }
  return faces;
}

}  // namespace

std::vector<MeshEdge> boundary_edges_off_box(const SurfaceMesh& mesh, const Box3& box, double on_box) {
  // Around an inner vertex the triangles' other corners form a cycle: each comes once first and once second. So the
  // differences add up to zero; on the boundary to the last less the first.
  std::vector<std::uint32_t> difference(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) difference[t[i]] += t[(i + 1) % 3] - t[(i + 2) % 3];
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;  // between boundary vertices, as triangles run along them
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      if (difference[from] == 0 || difference[to] == 0) continue;
      const unsigned common = faces_with(mesh.points[from], box, on_box) & faces_with(mesh.points[to], box, on_box);
      if (common == 0) sides.emplace_back(from, to);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (const auto& [from, to] : sides) {
    if (std::binary_search(sides.begin(), sides.end(), std::pair(to, from))) continue;
    edges.push_back({std::min(from, to), std::max(from, to)});
  }
  return edges;
}

}  // namespace deliso
