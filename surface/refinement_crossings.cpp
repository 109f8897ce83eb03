#include "surface/refinement_crossings.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/box_tree.h"

namespace deliso {

namespace {

Box3 box_of(const RefinementMesh& mesh, std::uint32_t triangle) {
  Box3 box;
  for (const std::uint32_t v : mesh.triangles[triangle].corners) box.extend(mesh.vertices[v].point);
  return box;
}

std::vector<Vec3> points_of(const RefinementMesh& mesh) {
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (const RefinementMesh::Vertex& v : mesh.vertices) points.push_back(v.point);
  return points;
}

}  // namespace

SelfIntersections meeting_pairs(const RefinementMesh& mesh, int threads) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const RefinementMesh::Triangle& t : mesh.triangles) triangles.push_back(t.corners);
  return self_intersections(points_of(mesh), triangles, kMostMeetingPairs, threads);
}

SelfIntersections meeting_pairs_of_renewed(const RefinementMesh& mesh, int threads) {
  std::vector<std::uint32_t> renewed;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangles[t].is_renewed()) renewed.push_back(t);
  }
  if (renewed.empty()) return {};
  const BoxTree tree(
      renewed.size(), [&](std::size_t i) { return box_of(mesh, renewed[i]); }, threads);
  std::vector<std::array<std::uint32_t, 3>> near;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_near = mesh.triangles[t].is_renewed();
    if (!is_near) tree.for_each_meeting(box_of(mesh, t), [&](std::uint32_t) { is_near = true; });
    if (is_near) near.push_back(mesh.triangles[t].corners);
  }
  return self_intersections(points_of(mesh), near, kMostMeetingPairs, threads);
}

}  // namespace deliso
