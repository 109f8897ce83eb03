#include "surface/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "delaunay/base/box3.h"
#include "surface/blocks.h"
#include "surface/link_sides.h"
#include "surface/sides_of_facets.h"
#include "surface/surface_distance.h"

namespace deliso {

namespace {

// How far a sample may be left out by the mesh. Stage 1 leaves out crossings that are nearer to a sample than
// stage1.size_bound_voxels (0.3), so the crossings around it lie less than a voxel off the mesh, too.
constexpr double kSampleReach = 0.65;
constexpr std::size_t kFewSuspects = 4;  // fewer crossings than the triangles by so many times
// Crossings are asked about brick by brick of so many samples.
constexpr std::int32_t kBrick = 8;

// The blocks of space near some points: a cheap way to see that a small triangle is far from all of them.
class NearBlocks {
 public:
  explicit NearBlocks(const std::vector<Vec3>& points) {
    for (const Vec3& p : points) box_.extend(p);
    const Vec3 sides = box_.high - box_.low;
    side_ = std::max(kBlock, std::max({sides.x, sides.y, sides.z}) / kMostBlocks);
    for (std::size_t axis = 0; axis < 3; ++axis) dims_[axis] = block_of(box_.high, axis) + 2;
    is_near_.assign(static_cast<std::size_t>(dims_[0] * dims_[1] * dims_[2]), false);
    for (const Vec3& p : points) {
      const std::array<std::int64_t, 3> at = {block_of(p, 0), block_of(p, 1), block_of(p, 2)};
      for (std::int64_t k = at[2] - 1; k <= at[2] + 1; ++k) {
        for (std::int64_t j = at[1] - 1; j <= at[1] + 1; ++j) {
          for (std::int64_t i = at[0] - 1; i <= at[0] + 1; ++i) is_near_[place(i, j, k)] = true;
        }
      }
    }
  }

  // Points within this distance along each axis of one that is not near any are none of those given.
  [[nodiscard]] double reach() const { return side_; }
  [[nodiscard]] bool is_near(const Vec3& p) const {
    const std::array<std::int64_t, 3> at = {block_of(p, 0), block_of(p, 1), block_of(p, 2)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (at[axis] < 0 || at[axis] >= dims_[axis]) return false;
    }
    return is_near_[place(at[0], at[1], at[2])];
  }

 private:
  static constexpr double kBlock = 4;
  static constexpr double kMostBlocks = 256;  // along an axis

  // Block 0 is a margin, and so is the last one.
  [[nodiscard]] std::int64_t block_of(const Vec3& p, std::size_t axis) const {
    return static_cast<std::int64_t>(std::clamp(std::floor((p[axis] - box_.low[axis]) / side_), -2.0, 1e6)) + 1;
  }
  [[nodiscard]] std::size_t place(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(i + dims_[0] * (j + dims_[1] * k));
  }

  Box3 box_;
  double side_ = kBlock;
  std::array<std::int64_t, 3> dims_{};
  std::vector<bool> is_near_;
};

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
  const NearBlocks blocks(points);
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

std::vector<std::uint32_t> all_crossings(const ScalarGrid& grid, const IsosurfaceTopology& topology, int threads) {
  const std::vector<EdgeCrossing>& all = topology.crossings;
  std::array<std::size_t, 3> bricks{};  // along each axis
  for (std::size_t axis = 0; axis < 3; ++axis) bricks[axis] = static_cast<std::size_t>(grid.dims()[axis] / kBrick) + 1;
  std::vector<std::uint32_t> brick_of(all.size());
  for_each_block(all.size(), threads, [&](std::size_t first, std::size_t last) {
    const auto brick = [](double x) { return static_cast<std::size_t>(x) / kBrick; };
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 p = crossing_position(grid, all[i]);
      brick_of[i] = static_cast<std::uint32_t>(brick(p.x) + bricks[0] * (brick(p.y) + bricks[1] * brick(p.z)));
    }
  });
  // Sorted by counting; those of one brick stay in order.
  std::vector<std::uint32_t> next(bricks[0] * bricks[1] * bricks[2] + 1, 0);  // place of each brick's next crossing
  for (const std::uint32_t brick : brick_of) ++next[brick + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> crossings(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) crossings[next[brick_of[i]]++] = i;
  return crossings;
}

std::int64_t insert_uncovered(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology& topology, double min_distance,
                              std::vector<std::uint32_t>& suspects, int threads, std::vector<Vec3>* landmarks) {
  // The facets as they are: how they make up a manifold does not matter here. Where few crossings are left to ask
  // about, walks do not pay.
  SurfaceMesh mesh = facets_alone(restricted);
  if (suspects.size() > mesh.triangles.size() / kFewSuspects) link_sides(mesh);
  const auto position = [&](std::uint32_t crossing) {
    return scaled(crossing_position(grid, topology.crossings[crossing]), restricted.isosurface().step());
  };
  const MeshCover cover(mesh, threads);
  const std::vector<std::uint32_t> asked = std::move(suspects);
  std::vector<MeshCover::Cover> covers(asked.size());
  for_each_block(asked.size(), threads, [&](std::size_t first, std::size_t last) {
    std::vector<Vec3> points;
    for (std::size_t i = first; i < last; ++i) points.push_back(position(asked[i]));
    cover.look_at_all(points, std::span(covers).subspan(first, last - first));
  });
  suspects.clear();
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (covers[i] == MeshCover::Cover::kNone) suspects.push_back(asked[i]);
    if (landmarks != nullptr && covers[i] != MeshCover::Cover::kClose) landmarks->push_back(position(asked[i]));
  }
  std::int64_t inserted = 0;
  for (const std::uint32_t i : suspects) {
    const TetId start = restricted.delaunay().incident_tet(restricted.last_vertex());
    if (restricted.insert(position(i), start, min_distance) == RestrictedDelaunay::Outcome::kInserted) ++inserted;
  }
  return inserted;
}

}  // namespace deliso
