#include "surface/refinement_crossings.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/box_tree.h"

namespace deliso {

namespace {

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
      renewed.size(), [&](std::size_t i) { return mesh.box_of(renewed[i]); }, threads);
  std::vector<std::uint32_t> near;
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_near = mesh.triangles[t].is_renewed();
    if (!is_near) tree.for_each_meeting(mesh.box_of(t), [&](std::uint32_t) { is_near = true; });
    if (!is_near) continue;
    near.push_back(t);
    corners.push_back(mesh.triangles[t].corners);
  }
  // Of the pairs among these the ones that were there before do not count. If there are more than are kept, all do.
  SelfIntersections found = self_intersections(points_of(mesh), corners, kMostMeetingPairs, threads);
  const auto is_old = [&](const TrianglePair& pair) {
    return !mesh.triangles[near[pair.first]].is_renewed() && !mesh.triangles[near[pair.second]].is_renewed();
  };
  if (found.crossing_pairs == static_cast<std::int64_t>(found.crossing.size())) {
    found.crossing_pairs -= static_cast<std::int64_t>(std::erase_if(found.crossing, is_old));
  }
  if (found.touching_pairs == static_cast<std::int64_t>(found.touching.size())) {
    found.touching_pairs -= static_cast<std::int64_t>(std::erase_if(found.touching, is_old));
  }
  return found;
}

}  // namespace deliso
