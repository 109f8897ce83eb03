#include "surface/refine/disk/coverage_targets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "delaunay/base/box3.h"
#include "surface/base/parallel_blocks.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/nearness.h"
#include "surface/search/occupied_blocks.h"
#include "surface/search/point_grid.h"

namespace deliso {

namespace {

constexpr double kBlock = 2;             // side of the blocks near coverage targets
constexpr double kLikelyBlock = 3;       // and of those in which a likely triangle is looked for: hardly any holds none
constexpr double kFarthestTriangle = 6;  // where the nearest triangle is looked for
constexpr double kLong = 4;              // triangles with such an edge may be off the surface
constexpr double kTimesHeight = 2;
constexpr double kSmallRadius = kLong / 2;  // of a ball: no edge of its triangle is longer than the diameter
constexpr double kRounding = 1.01;

using nearness::widened;

class CoverageTargetSearch {
 public:
  CoverageTargetSearch(const RefinementMesh& mesh, const BallOf& ball_of, double least, int threads, bool is_all)
      : mesh_(mesh),
        ball_of_(ball_of),
        least_(is_all ? least : std::max(least, nearness::kCrossing)),
        threads_(threads),
        is_all_(is_all) {}

  [[nodiscard]] std::vector<Vec3> far_from_all(std::span<const Vec3> coverage_targets) const;
  // For coverage targets that are far from all triangles: their nearest triangles.
  [[nodiscard]] std::vector<MissedTarget> with_nearest(std::span<const Vec3> coverage_targets) const;

 private:
  void append_nearest(std::vector<Vec3>& targets, double reach, std::vector<MissedTarget>& found) const;
  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t triangle) const {
    return mesh_.corner_points(mesh_.triangles[triangle].corners);
  }
  [[nodiscard]] double squared_distance_to(const Vec3& p, std::size_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return squared_distance_to_triangle(p, a, b, c);
  }
  [[nodiscard]] std::vector<Vec3> beside_no_likely_triangle(std::span<const Vec3> coverage_targets) const;
  [[nodiscard]] std::vector<Vec3> beside_no_triangle(std::span<const Vec3> coverage_targets) const;
  // Decided by its ball.
  [[nodiscard]] bool is_small(std::uint32_t triangle) const {
    const double squared_radius = mesh_.triangles[triangle].ball.squared_radius;
    return squared_radius > 0 && squared_radius < kSmallRadius * kSmallRadius;
  }
  // How far from the middle of its ball the vicinity of a small triangle may reach, for a vicinity of this width.
  static double reach_of_small(double width) { return kRounding * (kSmallRadius * kRounding + width); }
  [[nodiscard]] double reach_of(std::uint32_t triangle) const;
  // A bound of the region in which a triangle is near: a box, and a slab around the triangle's plane.
  struct Vicinity {
    double reach = 0;
    Box3 box;
    Vec3 on_plane, normal;
    double most_off = std::numeric_limits<double>::infinity();  // in lengths of the normal

    [[nodiscard]] bool may_hold(const Vec3& p) const { return std::abs(dot(normal, p - on_plane)) <= most_off; }
  };
  [[nodiscard]] Vicinity vicinity_of(std::uint32_t triangle) const;

  const RefinementMesh& mesh_;
  const BallOf& ball_of_;
  double least_;
  int threads_;
  bool is_all_;  // nothing but least_ counts
};

// How far off a triangle a coverage target may be to count as near.
double CoverageTargetSearch::reach_of(std::uint32_t triangle) const {
  const auto [a, b, c] = corners(triangle);
  const double squared_edge = std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
  if (is_all_ || squared_edge <= kLong * kLong || !mesh_.triangles[triangle].has_hit()) return least_;
  const Vec3 normal = cross(b - a, c - a);
  const double h = std::abs(dot(normal, ball_of_(triangle).center - a)) / std::max(norm(normal), 1e-300);
  return std::max(least_, std::min(kTimesHeight * h, std::sqrt(squared_edge)));
}

// Most triangles have a small ball, with no coverage target around it. Then their corners, which are scattered in
// memory, need not be read. The box of a large triangle is mostly far off its plane.
CoverageTargetSearch::Vicinity CoverageTargetSearch::vicinity_of(std::uint32_t triangle) const {
  // Relative to the square of the box's diagonal; with a smaller area, rounding would distort the plane.
  constexpr double kLeastArea = 1e-6;
  const SurfaceDelaunayBall& ball = mesh_.triangles[triangle].ball;
  Vicinity vicinity;
  if (is_small(triangle)) {
    vicinity.reach = least_;
    vicinity.box = widened({ball.center, ball.center}, kRounding * std::sqrt(ball.squared_radius) + least_);
    return vicinity;
  }
  const Box3 box = mesh_.box_of(triangle);
  vicinity.reach = reach_of(triangle);
  vicinity.box = widened(box, vicinity.reach);
  const auto [a, b, c] = corners(triangle);
  const Vec3 normal = cross(b - a, c - a);
  const double area = norm(normal);
  if (!(area > kLeastArea * squared_norm(box.size()))) return vicinity;
  vicinity.on_plane = a;
  vicinity.normal = normal;
  vicinity.most_off = kRounding * vicinity.reach * area;
  return vicinity;
}

// Where triangles are large, there are fewer of them than coverage targets: then each triangle is compared with all
// targets near it.
std::vector<Vec3> CoverageTargetSearch::far_from_all(std::span<const Vec3> coverage_targets) const {
  if (coverage_targets.size() > mesh_.triangles.size()) return beside_no_triangle(coverage_targets);
  return beside_no_triangle(beside_no_likely_triangle(coverage_targets));
}

// For each coverage target the likely triangle is the one whose ball has the nearest middle, among the balls with their
// middles near the target's block. Nearly always this triangle is near. Which triangle is measured does not matter for
// the result, so threads may overwrite each other's finds.
std::vector<Vec3> CoverageTargetSearch::beside_no_likely_triangle(std::span<const Vec3> coverage_targets) const {
  if (coverage_targets.empty()) return {};
  const PointGrid blocks(coverage_targets, kLikelyBlock);
  // For each coverage target: the squared distance, in steps, in the upper half, and the triangle in the lower half.
  constexpr double kSteps = 1 << 20;
  constexpr double kMostSteps = 1 << 30;
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  std::vector<std::uint64_t> likely(coverage_targets.size(), kNone);
  for_each_block(mesh_.triangles.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const SurfaceDelaunayBall& ball = mesh_.triangles[t].ball;
      if (!(ball.squared_radius > 0)) continue;
      blocks.for_each_beside(ball.center, [&](std::uint32_t i) {
        const double steps = std::min(kSteps * squared_distance(coverage_targets[i], ball.center), kMostSteps);
        const std::uint64_t found = static_cast<std::uint64_t>(static_cast<std::int64_t>(steps)) << 32 | t;
        const std::atomic_ref best(likely[i]);
        if (found < best.load(std::memory_order_relaxed)) best.store(found, std::memory_order_relaxed);
      });
    }
  });
  return collect_in_blocks<Vec3>(coverage_targets.size(), threads_, [&](std::size_t i, std::vector<Vec3>& left) {
    const auto triangle = static_cast<std::uint32_t>(likely[i]);
    const bool is_near = likely[i] != kNone && squared_distance_to(coverage_targets[i], triangle) <= least_ * least_;
    if (!is_near) left.push_back(coverage_targets[i]);
  });
}

// The coverage targets to which no triangle is near enough.
std::vector<Vec3> CoverageTargetSearch::beside_no_triangle(std::span<const Vec3> coverage_targets) const {
  if (coverage_targets.empty()) return {};
  const PointGrid blocks(coverage_targets, kBlock);
  std::optional<OccupiedBlocks> near_blocks;  // only where it saves time
  if (coverage_targets.size() < mesh_.triangles.size()) near_blocks.emplace(coverage_targets, reach_of_small(least_));
  std::vector<std::uint8_t> is_near(coverage_targets.size(), 0);
  for_each_block(mesh_.triangles.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (near_blocks && is_small(t) && !near_blocks->is_near(mesh_.triangles[t].ball.center)) continue;
      const Vicinity vicinity = vicinity_of(t);
      const double most = vicinity.reach * vicinity.reach;
      blocks.for_each_near(vicinity.box, [&](std::uint32_t i) {
        const std::atomic_ref near(is_near[i]);
        if (near.load(std::memory_order_relaxed) != 0 || !vicinity.may_hold(coverage_targets[i])) return;
        if (squared_distance_to(coverage_targets[i], t) <= most) near.store(1, std::memory_order_relaxed);
      });
    }
  });
  std::vector<Vec3> far;
  for (std::size_t i = 0; i < coverage_targets.size(); ++i) {
    if (is_near[i] == 0) far.push_back(coverage_targets[i]);
  }
  return far;
}

// Within growing distances, since most targets are not much farther than is near.
std::vector<MissedTarget> CoverageTargetSearch::with_nearest(std::span<const Vec3> coverage_targets) const {
  std::vector<MissedTarget> found;
  std::vector<Vec3> left(coverage_targets.begin(), coverage_targets.end());
  for (double reach = std::min(2 * least_, kFarthestTriangle); !left.empty();
       reach = std::min(2 * reach, kFarthestTriangle)) {
    append_nearest(left, reach, found);
    if (reach == kFarthestTriangle) break;
  }
  return found;
}

// Takes away the targets that have a triangle nearer than that.
void CoverageTargetSearch::append_nearest(std::vector<Vec3>& targets, double reach,
                                          std::vector<MissedTarget>& found) const {
  const PointGrid blocks(targets, std::min(kBlock, reach));
  std::vector<MissedTarget> nearest;
  nearest.reserve(targets.size());
  for (const Vec3& p : targets) nearest.push_back({p, 0, reach * reach});
  const OccupiedBlocks near_blocks(targets, reach_of_small(reach));
  const auto near = collect_in_blocks<std::uint32_t>(mesh_.triangles.size(), threads_, [&](std::size_t i, auto& some) {
    const auto t = static_cast<std::uint32_t>(i);
    if (!is_small(t) || near_blocks.is_near(mesh_.triangles[t].ball.center)) some.push_back(t);
  });
  for (const std::uint32_t t : near) {
    blocks.for_each_near(widened(mesh_.box_of(t), reach), [&](std::uint32_t i) {
      const double squared = squared_distance_to(targets[i], t);
      if (squared < nearest[i].squared_distance) nearest[i] = {targets[i], t, squared};
    });
  }
  targets.clear();
  for (const MissedTarget& m : nearest) {
    if (m.squared_distance < reach * reach) {
      found.push_back(m);
    } else {
      targets.push_back(m.point);
    }
  }
}

}  // namespace

std::vector<MissedTarget> missed_targets(std::span<const Vec3> coverage_targets, const RefinementMesh& mesh,
                                         const BallOf& ball_of, double least, int threads, bool is_all) {
  const CoverageTargetSearch search(mesh, ball_of, least, threads, is_all);
  std::vector<MissedTarget> missed = search.with_nearest(search.far_from_all(coverage_targets));
  std::stable_sort(missed.begin(), missed.end(), [](const MissedTarget& a, const MissedTarget& b) {
    return a.squared_distance > b.squared_distance;
  });
  return missed;
}

}  // namespace deliso
