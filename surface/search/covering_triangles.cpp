#include "surface/search/covering_triangles.h"

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"
#include "surface/search/box_tree.h"
#include "surface/search/nearness.h"
#include "surface/search/occupied_blocks.h"

namespace deliso {

namespace {

constexpr double kBlock = 4;  // side of the blocks near samples

// A box that holds all that a triangle covers.
Box3 box_around(const SurfaceMesh& mesh, std::uint32_t t) {
  return nearness::widened(box_of(mesh, t), nearness::kSample);
}

}  // namespace

bool is_covered_by(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle) {
  return box_around(mesh, triangle).contains(p) &&
         nearness::is_near(p, mesh, mesh.triangles[triangle], nearness::kSample);
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
    // If a corner is far from all points and the triangle is small enough, it covers none: its sides plus kSampleReach
    // stay within a block.
    const double small = blocks.reach() - 2 * nearness::kSample;
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
