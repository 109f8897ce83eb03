#include "surface/surface_mesh.h"

#include <utility>

namespace deliso {

void append_pieces(const SurfaceMesh& from, const std::vector<std::uint32_t>& piece_of, const std::vector<bool>& wanted,
                   SurfaceMesh& to) {
  std::vector<std::uint32_t> new_vertex(from.points.size(), kNoSide);
  for (std::uint32_t v = 0; v < from.points.size(); ++v) {
    if (piece_of[v] >= wanted.size() || !wanted[piece_of[v]]) continue;
    new_vertex[v] = static_cast<std::uint32_t>(to.points.size());
    to.points.push_back(from.points[v]);
    if (!from.pole_heights.empty()) to.pole_heights.push_back(from.pole_heights[v]);
  }
  std::vector<std::uint32_t> new_triangle(from.triangles.size(), kNoSide);
  auto next = static_cast<std::uint32_t>(to.triangles.size());
  for (std::uint32_t t = 0; t < from.triangles.size(); ++t) {
    if (new_vertex[from.triangles[t][0]] != kNoSide) new_triangle[t] = next++;
  }
  for (std::uint32_t t = 0; t < from.triangles.size(); ++t) {
    if (new_triangle[t] == kNoSide) continue;
    const auto& v = from.triangles[t];
    to.triangles.push_back({new_vertex[v[0]], new_vertex[v[1]], new_vertex[v[2]]});
    to.neighbours.push_back(from.neighbours[t]);
    for (TriangleSide& side : to.neighbours.back()) {
      if (side != kNoSide) side = 4 * new_triangle[side >> 2] + (side & 3u);
    }
  }
}

Vec3 from_world(Vec3 p, const ScalarGrid& grid, const Vec3& step) {
  p = p - grid.origin();
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= step[axis] / grid.spacing()[axis];
  return p;
}

TriangleMesh to_world(SurfaceMesh mesh, const ScalarGrid& grid, const Vec3& step) {
  const Vec3 scale{grid.spacing().x / step.x, grid.spacing().y / step.y, grid.spacing().z / step.z};
  for (Vec3& p : mesh.points) p = grid.origin() + scaled(scale, p);
  return {std::move(mesh.points), std::move(mesh.triangles)};
}

}  // namespace deliso
