#include "surface/mesh/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace deliso {

namespace {

// Reserves little more than so many elements: an array that grows by itself may take twice the room it needs.
template <class Element>
void make_room(std::vector<Element>& array, std::size_t count) {
  if (count > array.capacity()) array.reserve(std::max(count, array.size() + array.size() / 4));
}

// Where a surface has been closed along the faces of a box, puts the points there onto them: none lies outside, and
// those inside by next to nothing are on them but for rounding.
void settle_on_walls(std::vector<Vec3>& points, const Box3& walls, const Vec3& spacing) {
  constexpr double kOfSpacing = 0x1p-20, kOfCoordinate = 0x1p-50;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = walls.low[axis], high = walls.high[axis];
    const double near = kOfSpacing * spacing[axis] + kOfCoordinate * std::max(std::abs(low), std::abs(high));
    for (Vec3& p : points) {
      if (p[axis] <= low + near) p[axis] = low;
      if (p[axis] >= high - near) p[axis] = high;
    }
  }
}

}  // namespace

void append_pieces(const SurfaceMesh& from, const std::vector<std::uint32_t>& piece_of, const std::vector<bool>& wanted,
                   SurfaceMesh& to) {
  std::vector<std::uint32_t> new_vertex(from.points.size(), kNoSide);
  auto count = static_cast<std::uint32_t>(to.points.size());
  for (std::uint32_t v = 0; v < from.points.size(); ++v) {
    if (piece_of[v] < wanted.size() && wanted[piece_of[v]]) new_vertex[v] = count++;
  }
  make_room(to.points, count);
  if (!from.pole_heights.empty()) make_room(to.pole_heights, count);
  for (std::uint32_t v = 0; v < from.points.size(); ++v) {
    if (new_vertex[v] == kNoSide) continue;
    to.points.push_back(from.points[v]);
    if (!from.pole_heights.empty()) to.pole_heights.push_back(from.pole_heights[v]);
  }
  std::vector<std::uint32_t> new_triangle(from.triangles.size(), kNoSide);
  auto next = static_cast<std::uint32_t>(to.triangles.size());
  for (std::uint32_t t = 0; t < from.triangles.size(); ++t) {
    if (new_vertex[from.triangles[t][0]] != kNoSide) new_triangle[t] = next++;
  }
  make_room(to.triangles, next);
  make_room(to.neighbours, next);
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

void drop_triangles(SurfaceMesh& mesh, const std::vector<bool>& is_gone) {
  DELISO_CHECK(mesh.pole_heights.empty() || mesh.pole_heights.size() == mesh.points.size(), "one for each vertex");
  // The new index of each triangle; and the vertices that are used.
  std::vector<std::uint32_t> place(mesh.triangles.size(), 0);
  std::vector<bool> is_used(mesh.points.size(), false);
  std::uint32_t triangles = 0;
  for (std::size_t t = 0; t < place.size(); ++t) {
    if (is_gone[t]) continue;
    place[t] = triangles++;
    for (const std::uint32_t v : mesh.triangles[t]) is_used[v] = true;
  }
  std::vector<std::uint32_t> name(mesh.points.size(), 0);
  std::uint32_t vertices = 0;
  for (std::size_t v = 0; v < name.size(); ++v) {
    if (!is_used[v]) continue;
    name[v] = vertices++;
    mesh.points[name[v]] = mesh.points[v];
    if (!mesh.pole_heights.empty()) mesh.pole_heights[name[v]] = mesh.pole_heights[v];
  }
  for (std::size_t t = 0; t < place.size(); ++t) {
    if (is_gone[t]) continue;
    for (unsigned i = 0; i < 3; ++i) {
      mesh.triangles[place[t]][i] = name[mesh.triangles[t][i]];
      if (mesh.neighbours.empty()) continue;
      const TriangleSide side = mesh.neighbours[t][i];
      mesh.neighbours[place[t]][i] = side == kNoSide ? kNoSide : 4 * place[side >> 2] + (side & 3u);
    }
  }
  mesh.points.resize(vertices);
  if (!mesh.pole_heights.empty()) mesh.pole_heights.resize(vertices);
  mesh.triangles.resize(triangles);
  if (!mesh.neighbours.empty()) mesh.neighbours.resize(triangles);
}

Vec3 from_world(Vec3 p, const Isosurface& isosurface) {
  const ScalarGrid& grid = isosurface.grid();
  p = p - grid.origin();
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= isosurface.step()[axis] / grid.spacing()[axis];
  return p;
}

std::vector<Vec3> places_in_world(const SurfaceMesh& mesh, const Isosurface& isosurface) {
  SurfaceMesh points;
  points.points = mesh.points;
  return to_world(std::move(points), isosurface).points;
}

TriangleMesh to_world(SurfaceMesh mesh, const Isosurface& isosurface) {
  const ScalarGrid& grid = isosurface.grid();
  const Vec3& step = isosurface.step();
  const Vec3 scale{grid.spacing().x / step.x, grid.spacing().y / step.y, grid.spacing().z / step.z};
  for (Vec3& p : mesh.points) p = grid.origin() + scaled(scale, p);
  if (grid.walls()) settle_on_walls(mesh.points, *grid.walls(), grid.spacing());
  return {std::move(mesh.points), std::move(mesh.triangles)};
}

}  // namespace deliso
