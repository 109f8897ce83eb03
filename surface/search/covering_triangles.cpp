#include "surface/search/covering_triangles.h"

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"
#include "surface/search/occupied_blocks.h"

namespace deliso {

namespace {

// How far a sample may be left out by the mesh. Stage 1 leaves out crossings that are nearer to a sample than
// stage1.size_bound_voxels (0.3), so the crossings around it lie less than a voxel off the mesh, too.
constexpr double kSampleReach = 0.65;
constexpr double kBlock = 4;  // side of the blocks near samples

// All that a triangle covers lies in it.
Box3 box_around(const SurfaceMesh& mesh, std::uint32_t t) {
  constexpr Vec3 kReach{kSampleReach, kSampleReach, kSampleReach};
  const Box3 box = box_of(mesh, t);
  return {box.low - kReach, box.high + kReach};
}

}  // namespace

bool is_covered_by(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle) {
  if (!box_around(mesh, triangle).contains(p)) return false;
  const auto& v = mesh.triangles[triangle];
  return squared_distance_to_triangle(p, mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) <=
         kSampleReach * kSampleReach;
}

std::vector<std::uint32_t> covering_triangles(const std::vector<Vec3>& points, const SurfaceMesh& mesh,
                                              const std::function<bool(std::uint32_t)>& takes, int threads) {
  std::vector<std::uint32_t> covering(points.size(), kNoTriangle);
  if (points.empty()) return covering;
  std::vector<Box3> boxes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) boxes[i].extend(points[i]);
  const BoxTree tree(boxes);
  const OccupiedBlocks blocks(points, kBlock);
  const auto append_if_near = [&](std::size_t i, std::vector<std::uint32_t>& near) {
    const auto t = static_cast<std::uint32_t>(i);
    // A corner far from all points tells of a small triangle: sides and reach together stay within a block.
    const double small = blocks.reach() - 2 * kSampleReach;
    if (!blocks.is_near(mesh.points[mesh.triangles[t][0]]) && squared_longest_edge(mesh, t) <= small * small) return;
    if (takes(t)) near.push_back(t);
  };
  for (const std::uint32_t t : collect_in_blocks<std::uint32_t>(mesh.triangles.size(), threads, append_if_near)) {
    tree.for_each_meeting(box_around(mesh, t), [&](std::uint32_t i) {
      if (covering[i] == kNoTriangle && is_covered_by(points[i], mesh, t)) covering[i] = t;
    });
  }
  return covering;
}

}  // namespace deliso
