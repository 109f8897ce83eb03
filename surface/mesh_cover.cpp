#include "surface/mesh_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "delaunay/constructions.h"
#include "surface/surface_distance.h"

namespace deliso {

namespace {

constexpr double kNear = 0.8;  // mesh-space units
constexpr double kClose = 0.5;
// How far off the surface a triangle of stage 1 is taken to be at most, in circumradii.
constexpr double kRadiusFraction = 0.3;
constexpr int kLongestWalk = 16;  // triangles
// Points are looked at together when at least so many in a row fit into a box with this diagonal, the triangle there
// has an edge of this length, and at most so many triangles are near. (With two thirds of the diagonal stage 1 of
// shells of 256^3 samples takes a fourth longer, with twice the edge a tenth; others between half and twice are alike.)
constexpr std::size_t kFewestTogether = 4;
constexpr double kDiagonal = 9;
constexpr double kCoarse = 16;
constexpr std::size_t kMostCandidates = 16;

// The circumradius or, of a sliver, whose circumradius tells nothing, the longest edge.
double extent(const SurfaceMesh& mesh, std::uint32_t t) {
  const auto& v = mesh.triangles[t];
  const double radius = circumcircle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]).radius;
  const double edge = std::sqrt(squared_longest_edge(mesh, t));
  return radius < edge ? radius : edge;
}

}  // namespace

MeshCover::MeshCover(const SurfaceMesh& mesh, int threads)
    : mesh_(mesh),
      tree_(
          mesh.triangles.size(), [&](std::size_t t) { return box_of(mesh, static_cast<std::uint32_t>(t)); }, threads) {}

double MeshCover::squared_distance_to(const Vec3& p, std::uint32_t triangle) const {
  const auto& v = mesh_.triangles[triangle];
  return squared_distance_to_triangle(p, mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
}

MeshCover::Cover MeshCover::cover_by(const Nearest& nearest) const {
  if (nearest.squared < kClose * kClose) return Cover::kClose;
  if (nearest.squared < kNear * kNear) return Cover::kFar;
  const double reach = kRadiusFraction * extent(mesh_, nearest.triangle);
  return nearest.squared <= reach * reach ? Cover::kFar : Cover::kNone;
}

MeshCover::Cover MeshCover::look(const Vec3& p, std::uint32_t& guess) const {
  if (mesh_.triangles.empty()) return Cover::kNone;
  // From triangle to triangle across sides, ever nearer: most points have a triangle close by that is found so.
  const Nearest reached = walk_towards(p, guess);
  if (reached.squared < kNear * kNear) guess = reached.triangle;
  if (reached.squared < kClose * kClose) return Cover::kClose;
  // The nearest of all is no farther than that (a little more, so that the one reached is found as well); or, when it
  // is near enough already, only a close one matters.
  const double bound = reached.squared < kNear * kNear ? kClose * kClose : 1.001 * reached.squared;
  const auto [triangle, squared] = tree_.nearest(p, bound, [&](std::uint32_t t) { return squared_distance_to(p, t); });
  if (triangle == BoxTree::kNone) return Cover::kFar;
  const Cover cover = cover_by({triangle, squared});
  if (cover != Cover::kNone) guess = triangle;
  return cover;
}

MeshCover::Nearest MeshCover::walk_towards(const Vec3& p, std::uint32_t start) const {
  const auto look_at = [&](std::uint32_t triangle) {
    const auto [a, b, c] = mesh_.triangles[triangle];
    return near_sides_of_triangle(p, mesh_.points[a], mesh_.points[b], mesh_.points[c]);
  };
  std::uint32_t at = start;
  NearSides here = look_at(at);
  if (mesh_.neighbours.empty()) return {at, here.squared_distance};
  bool goes_on = true;
  for (int step = 0; goes_on && step < kLongestWalk && here.squared_distance >= kClose * kClose; ++step) {
    goes_on = false;
    for (unsigned i = 0; i < here.count && !goes_on; ++i) {
      const TriangleSide side = mesh_.neighbours[at][here.sides[i]];
      if (side == kNoSide) continue;
      const NearSides there = look_at(side >> 2);
      goes_on = there.squared_distance < here.squared_distance;
      if (goes_on) at = side >> 2, here = there;
    }
  }
  return {at, here.squared_distance};
}

bool MeshCover::is_coarse(std::uint32_t triangle) const {
  return squared_longest_edge(mesh_, triangle) >= kCoarse * kCoarse;
}

void MeshCover::look_at_all(std::span<const Vec3> points, std::span<Cover> covers) const {
  if (mesh_.triangles.empty()) {
    std::fill(covers.begin(), covers.end(), Cover::kNone);
    return;
  }
  std::uint32_t guess = 0;
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    Box3 box, larger;
    for (; end < points.size(); ++end) {
      larger.extend(points[end]);
      if (larger.diagonal() > kDiagonal) break;
      box = larger;
    }
    const auto run = points.subspan(first, end - first);
    const auto answers = covers.subspan(first, end - first);
    if (run.size() >= kFewestTogether && is_coarse(guess) && look_together(run, box, answers, guess)) continue;
    for (std::size_t i = 0; i < run.size(); ++i) answers[i] = look(run[i], guess);
  }
}

// The triangles that may be nearest to a point of a small box, by their distance from its middle.
class MeshCover::Candidates {
 public:
  // `distance`: of the nearest of all from the middle.
  Candidates(const MeshCover& cover, const Box3& box, double distance)
      : cover_(cover), middle_(0.5 * box.low + 0.5 * box.high) {
    // Half a diagonal from the middle to the point, and back.
    const double reach = 1.001 * (distance + box.diagonal());
    const Vec3 around{reach, reach, reach};
    cover.tree_.for_each_meeting({middle_ - around, middle_ + around}, [&](std::uint32_t t) {
      const double squared = cover.squared_distance_to(middle_, t);
      if (squared > reach * reach) return;
      if (count_ < kMostCandidates) found_[count_] = {std::sqrt(squared), t};
      ++count_;
    });
    if (!are_few()) return;
    std::sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count_));
  }
  [[nodiscard]] bool are_few() const { return count_ <= kMostCandidates; }

  [[nodiscard]] Nearest nearest_to(const Vec3& p) const {
    const double off = distance(p, middle_);
    Nearest best{0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < count_; ++i) {
      const auto [from_middle, triangle] = found_[i];
      const double least = 0.999 * from_middle - off;
      if (least > 0 && least * least > best.squared) break;
      const double squared = cover_.squared_distance_to(p, triangle);
      if (squared < best.squared || (squared == best.squared && triangle < best.triangle)) best = {triangle, squared};
    }
    return best;
  }

 private:
  const MeshCover& cover_;
  Vec3 middle_;
  std::size_t count_ = 0;
  std::array<std::pair<double, std::uint32_t>, kMostCandidates> found_;
};

// Points within a small box; false when too many triangles are near.
bool MeshCover::look_together(std::span<const Vec3> run, const Box3& box, std::span<Cover> covers,
                              std::uint32_t& guess) const {
  const Vec3 middle = 0.5 * box.low + 0.5 * box.high;
  const Nearest reached = walk_towards(middle, guess);
  const auto [triangle, squared] =
      tree_.nearest(middle, 1.001 * reached.squared, [&](std::uint32_t t) { return squared_distance_to(middle, t); });
  guess = triangle == BoxTree::kNone ? reached.triangle : triangle;
  const Candidates candidates(*this, box, std::sqrt(squared));
  if (!candidates.are_few()) return false;
  for (std::size_t i = 0; i < run.size(); ++i) covers[i] = cover_by(candidates.nearest_to(run[i]));
  return true;
}

}  // namespace deliso
