#include "surface/search/coverage_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "delaunay/constructions.h"
#include "surface/search/nearness.h"

namespace deliso {

namespace {

using nearness::kClose;
constexpr double kNear = nearness::kCrossing;
// Consecutive points that fit into a box with this diagonal, as those of a brick do (surface/recover/coverage.cpp),
// share one list of the triangles near any of them.
constexpr double kGroupDiagonal = 14;
// Points without a near triangle are handled together when at least kFewestTogether consecutive ones fit into a box
// with this diagonal, the triangle there has an edge of this length, and at most so many triangles are near. (With two
// thirds of the diagonal stage 1 of shells of 256^3 samples takes a fourth longer, with twice the edge a tenth longer.
// Other values between half and twice these make no difference.)
constexpr std::size_t kFewestTogether = 4;
constexpr double kDiagonal = 9;
constexpr double kCoarse = 16;
constexpr std::size_t kMostCandidates = 16;

// The circumradius; for a sliver, whose circumradius is meaningless, the longest edge.
double extent(const SurfaceMesh& mesh, std::uint32_t t) {
  const auto& v = mesh.triangles[t];
  const double radius = circumcircle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]).radius;
  const double edge = std::sqrt(squared_longest_edge(mesh, t));
  return radius < edge ? radius : edge;
}

// Calls visit(first, end, box) for maximal runs of consecutive points that lie within a box with this diagonal.
template <class Visit>
void for_each_run(std::span<const Vec3> points, double diagonal, Visit&& visit) {
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    Box3 box, larger;
    for (; end < points.size(); ++end) {
      larger.extend(points[end]);
      if (squared_norm(larger.size()) > diagonal * diagonal) break;
      box = larger;
    }
    visit(first, end, box);
  }
}

}  // namespace

CoverageQuery::CoverageQuery(const SurfaceMesh& mesh, int threads)
    : mesh_(mesh),
      tree_(
          mesh.triangles.size(), [&](std::size_t t) { return box_of(mesh, static_cast<std::uint32_t>(t)); }, threads) {}

double CoverageQuery::squared_distance_to(const Vec3& p, std::uint32_t triangle) const {
  return nearness::squared_distance(p, mesh_, mesh_.triangles[triangle]);
}

CoverageQuery::Cover CoverageQuery::cover_by(const Nearest& nearest) const {
  if (nearest.squared < kClose * kClose) return Cover::kClose;
  if (nearest.squared < kNear * kNear) return Cover::kFar;
  const double reach = nearness::kOfCircumradius * extent(mesh_, nearest.triangle);
  return nearest.squared <= reach * reach ? Cover::kFar : Cover::kNone;
}

CoverageQuery::Cover CoverageQuery::look(const Vec3& p, std::uint32_t& guess) const {
  if (mesh_.triangles.empty()) return Cover::kNone;
  const double reached = squared_distance_to(p, guess);
  if (reached < kClose * kClose) return Cover::kClose;
  // The nearest triangle is no farther than that (slightly more, so that the one already found is found again). If that
  // one is near enough, only a close one still matters.
  const double bound = reached < kNear * kNear ? kClose * kClose : 1.001 * reached;
  const auto [triangle, squared] = tree_.nearest(p, bound, [&](std::uint32_t t) { return squared_distance_to(p, t); });
  if (triangle == BoxTree::kNone) return Cover::kFar;
  guess = triangle;
  return cover_by({triangle, squared});
}

bool CoverageQuery::is_coarse(std::uint32_t triangle) const {
  return squared_longest_edge(mesh_, triangle) >= kCoarse * kCoarse;
}

void CoverageQuery::look_at_all(std::span<const Vec3> points, std::span<Cover> covers) const {
  if (mesh_.triangles.empty()) {
    std::fill(covers.begin(), covers.end(), Cover::kNone);
    return;
  }
  Work work;
  for_each_run(points, kGroupDiagonal, [&](std::size_t first, std::size_t end, const Box3& box) {
    look_at_group(points.subspan(first, end - first), box, covers.subspan(first, end - first), work);
  });
}

// Handles points within a small box. Bounds show for most points that a triangle is close, and for most others how far
// it is; few distances are measured.
void CoverageQuery::look_at_group(std::span<const Vec3> group, const Box3& box, std::span<Cover> covers,
                                  Work& work) const {
  find_near(box, work);
  work.left.clear();
  for (std::size_t first = 0; first < group.size(); first += DistanceBounds::kMostPoints) {
    const auto few = group.subspan(first, std::min(DistanceBounds::kMostPoints, group.size() - first));
    const DistanceBounds bounds = bounds_of(few, 0.5 * box.low + 0.5 * box.high, work);
    for (std::size_t i = 0; i < few.size(); ++i) {
      Cover& cover = covers[first + i];
      cover = Cover::kNone;
      if (bounds.is_within(i, kClose)) {
        cover = Cover::kClose;
      } else if (bounds.is_beyond(i, kClose) && bounds.is_within(i, kNear)) {
        cover = Cover::kFar;
      } else if (!bounds.is_beyond(i, kNear)) {
        cover = cover_by_near(few[i], work);
      }
      if (cover == Cover::kNone) work.left.push_back(first + i);
    }
  }
  look_at_left(group, covers, work);
}

void CoverageQuery::find_near(const Box3& box, Work& work) const {
  const Vec3 middle = 0.5 * box.low + 0.5 * box.high;
  work.near.clear();
  tree_.for_each_meeting(nearness::widened(box, kNear), [&](std::uint32_t t) {
    const auto& v = mesh_.triangles[t];
    const Vec3 &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
    work.near.push_back({t, nearness::widened(box_of(mesh_, t), kNear), TrianglePlanes(a, b, c, middle)});
  });
}

DistanceBounds CoverageQuery::bounds_of(std::span<const Vec3> points, const Vec3& middle, const Work& work) {
  DistanceBounds bounds(points, middle);
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  for (const Near& near : work.near) {
    if (near.box.meets(box)) bounds.add(near.planes);
  }
  return bounds;
}

// The answer as far as the triangles near a group determine it.
CoverageQuery::Cover CoverageQuery::cover_by_near(const Vec3& p, const Work& work) const {
  double least = kNear * kNear;
  for (const Near& near : work.near) {
    if (near.box.contains(p)) least = std::min(least, squared_distance_to(p, near.triangle));
  }
  return least < kClose * kClose ? Cover::kClose : least < kNear * kNear ? Cover::kFar : Cover::kNone;
}

// Handles the points of a group that have no near triangle.
void CoverageQuery::look_at_left(std::span<const Vec3> group, std::span<Cover> covers, Work& work) const {
  std::vector<Vec3> points;
  for (const std::size_t i : work.left) points.push_back(group[i]);
  for_each_run(points, kDiagonal, [&](std::size_t first, std::size_t end, const Box3& box) {
    const auto run = std::span<const Vec3>(points).subspan(first, end - first);
    const auto places = std::span<const std::size_t>(work.left).subspan(first, end - first);
    const bool is_together = run.size() >= kFewestTogether && is_coarse(work.guess);
    if (is_together && look_together(run, box, places, covers, work.guess)) return;
    for (std::size_t i = 0; i < run.size(); ++i) covers[places[i]] = look(run[i], work.guess);
  });
}

// The triangles that may be nearest to some point of a small box, in the order of their distance from its middle.
class CoverageQuery::Candidates {
 public:
  // `distance`: from the middle to the nearest triangle.
  Candidates(const CoverageQuery& cover, const Box3& box, double distance)
      : cover_(cover), middle_(0.5 * box.low + 0.5 * box.high) {
    // From the middle to a point is half a diagonal; the nearest triangle of the point adds another half.
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
    Nearest best;
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
  const CoverageQuery& cover_;
  Vec3 middle_;
  std::size_t count_ = 0;
  std::array<std::pair<double, std::uint32_t>, kMostCandidates> found_;
};

// Handles points within a small box; the covers to set have the given indices. False when too many triangles are near.
bool CoverageQuery::look_together(std::span<const Vec3> run, const Box3& box, std::span<const std::size_t> places,
                                  std::span<Cover> covers, std::uint32_t& guess) const {
  const Vec3 middle = 0.5 * box.low + 0.5 * box.high;
  const double reached = squared_distance_to(middle, guess);
  const auto [triangle, squared] =
      tree_.nearest(middle, 1.001 * reached, [&](std::uint32_t t) { return squared_distance_to(middle, t); });
  if (triangle != BoxTree::kNone) guess = triangle;
  const Candidates candidates(*this, box, std::sqrt(squared));
  if (!candidates.are_few()) return false;
  for (std::size_t i = 0; i < run.size(); ++i) covers[places[i]] = cover_by(candidates.nearest_to(run[i]));
  return true;
}

}  // namespace deliso
