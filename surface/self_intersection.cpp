#include "surface/self_intersection.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/box3.h"
#include "delaunay/base/check.h"
#include "delaunay/base/parallel.h"
#include "surface/box_pairs.h"
#include "surface/halving_order.h"
#include "surface/laid_out_umbrellas.h"

namespace deliso {

namespace {

Box3 box_of(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& triangle) {
  Box3 box;
  for (const std::uint32_t v : triangle) box.extend(points[v]);
  return box;
}

// Counts a pair, and keeps it when it is among the first ones by number: pairs come in the order of halving.
class PairCollector {
 public:
  explicit PairCollector(std::size_t keep) : keep_(keep) {}

  void add(const TrianglePair& pair) {
    const bool is_crossing = pair.contact == TriangleContact::kCrossing;
    ++(is_crossing ? found_.crossing_pairs : found_.touching_pairs);
    insert(is_crossing ? found_.crossing : found_.touching, pair);
  }
  void add(const PairCollector& other) {
    found_.crossing_pairs += other.found_.crossing_pairs;
    found_.touching_pairs += other.found_.touching_pairs;
    for (const TrianglePair& pair : other.found_.crossing) insert(found_.crossing, pair);
    for (const TrianglePair& pair : other.found_.touching) insert(found_.touching, pair);
  }
  SelfIntersections sorted() && {
    std::sort_heap(found_.crossing.begin(), found_.crossing.end(), earlier);
    std::sort_heap(found_.touching.begin(), found_.touching.end(), earlier);
    return std::move(found_);
  }

 private:
  static bool earlier(const TrianglePair& a, const TrianglePair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  void insert(std::vector<TrianglePair>& kept, const TrianglePair& pair) const {
    kept.push_back(pair);
    std::push_heap(kept.begin(), kept.end(), earlier);
    if (kept.size() <= keep_) return;
    std::pop_heap(kept.begin(), kept.end(), earlier);
    kept.pop_back();
  }

  std::size_t keep_;
  SelfIntersections found_;
};

Vec3 middle_of_common(const Box3& a, const Box3& b) {
  Vec3 middle;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * std::max(a.low[axis], b.low[axis]) + 0.5 * std::min(a.high[axis], b.high[axis]);
  }
  return middle;
}

// The number that follows that of a vertex the triangles share; 0 when there is none. Numbers are below 2^31. Nothing
// here can be foretold, and compilers make branches of comparisons: so by the sign of what a subtraction leaves.
std::uint32_t after_shared_vertex(const std::array<std::uint32_t, 3>& s, const std::array<std::uint32_t, 3>& t) {
  std::uint32_t found = 0;
  for (const std::uint32_t v : s) {
    const std::uint32_t signs = ((v ^ t[0]) - 1) | ((v ^ t[1]) - 1) | ((v ^ t[2]) - 1);  // the top one: v is in t
    found ^= (found ^ (v + 1)) & (0u - (signs >> 31));
  }
  return found;
}

// The triangles that have an area, in the order of halving, and their vertices in the order in which they come there:
// so what lies near each other in space does so in memory.
class OrderedTriangles {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  OrderedTriangles(std::span<const Vec3> points, std::span<const Corners> triangles, int threads) {
    Box3 all;
    for (const Vec3& p : points) all.extend(p);
    low_ = all.low;
    numbers_ = order(points, triangles, all, threads);
    renumber(points, triangles);
  }

  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  // In the numbers of the input.
  [[nodiscard]] std::uint32_t number(std::size_t i) const { return numbers_[i]; }
  // In numbers of their own.
  [[nodiscard]] const std::vector<Corners>& corners() const { return corners_; }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  // No point lies below.
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] Box3 box(std::size_t i) const { return box_of(points_, corners_[i]); }

  [[nodiscard]] TrianglePair pair(std::uint32_t i, std::uint32_t j, TriangleContact contact) const {
    const auto [first, second] = std::minmax(numbers_[i], numbers_[j]);
    return {first, second, contact, middle_of_common(box(i), box(j))};
  }

 private:
  static std::vector<std::uint32_t> order(std::span<const Vec3> points, std::span<const Corners> triangles,
                                          const Box3& all, int threads) {
    const CentreLattice lattice(all);
    std::vector<LatticePlace> places;
    places.reserve(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      if (!has_area(points[a], points[b], points[c])) continue;
      const Box3 box = box_of(points, triangles[t]);
      // Halved terms cannot overflow.
      places.push_back(lattice.place(0.5 * box.low + 0.5 * box.high, t));
    }
    const auto centre_of = [&](std::uint32_t t) {
      const Box3 box = box_of(points, triangles[t]);
      return 0.5 * box.low + 0.5 * box.high;
    };
    return halving_order(std::move(places), centre_of, threads);
  }

  void renumber(std::span<const Vec3> points, std::span<const Corners> triangles) {
    constexpr std::uint32_t kUnseen = 0xFFFFFFFFU;
    DELISO_CHECK(points.size() < std::size_t{1} << 31, "numbers of vertices leave the top bit free");
    std::vector<std::uint32_t> renumbered(points.size(), kUnseen);
    points_.reserve(std::min(points.size(), 3 * size()));
    corners_.reserve(size());
    for (const std::uint32_t t : numbers_) {
      Corners corners = triangles[t];
      for (std::uint32_t& v : corners) {
        std::uint32_t& number = renumbered[v];
        if (number == kUnseen) {
          number = static_cast<std::uint32_t>(points_.size());
          points_.push_back(points[v]);
        }
        v = number;
      }
      corners_.push_back(corners);
    }
  }

  std::vector<std::uint32_t> numbers_;
  std::vector<Corners> corners_;
  std::vector<Vec3> points_;
  Vec3 low_;
};

// Whether floats tell most triangles apart.
bool floats_do(const OrderedTriangles& triangles) {
  constexpr double kSmallest = 0x1p-19;  // of the whole; a rounded coordinate is off by 2^-25 of it at most
  constexpr std::size_t kMostSmall = 1000;
  Box3 all;
  for (const Vec3& p : triangles.points()) all.extend(p);
  const double smallest = kSmallest * norm(all.size());
  std::size_t small = 0;
  for (std::size_t i = 0; i < triangles.size() && small <= kMostSmall; ++i) {
    small += norm(triangles.box(i).size()) < smallest ? 1 : 0;
  }
  return small <= kMostSmall;
}

// Broad phase: pairs of boxes that touch, but not pairs at a vertex around which nothing meets; narrow phase: exact
// tests.
template <class Real>
PairCollector find_pairs(std::span<const std::uint8_t> marks, const OrderedTriangles& ordered, std::size_t keep,
                         int threads) {
  const std::vector<OrderedTriangles::Corners>& corners = ordered.corners();
  const BoxPairs<Real> pairs(ordered.size(), ordered.low(), [&](std::size_t i) { return ordered.box(i); });
  const std::vector<std::uint8_t> laid_out = laid_out_umbrellas(ordered.points(), corners, threads);
  const auto examine = [&](std::uint32_t i, std::uint32_t j, PairCollector& found) {
    if (!marks.empty() && marks[ordered.number(i)] == 0 && marks[ordered.number(j)] == 0) return;
    const TriangleContact contact = triangle_contact(ordered.points(), corners[i], corners[j]);
    if (contact != TriangleContact::kNone) found.add(ordered.pair(i, j, contact));
  };
  const auto tasks = pairs.tasks();
  std::vector<PairCollector> found(tasks.size(), PairCollector(keep));
  run_tasks(tasks.size(), threads, [&](std::size_t task) {
    pairs.for_each(tasks[task],
                   [&, corners = corners.data(), laid_out = laid_out.data()](std::uint32_t i, std::uint32_t j) {
                     const std::uint32_t after_shared = after_shared_vertex(corners[i], corners[j]);
                     if (after_shared == 0 || laid_out[after_shared - 1] == 0) [[unlikely]]
                       examine(i, j, found[task]);
                   });
  });
  PairCollector all(keep);
  for (const PairCollector& part : found) all.add(part);
  return all;
}

SelfIntersections examined(const OrderedTriangles& ordered, std::size_t triangle_count,
                           std::span<const std::uint8_t> marks, std::size_t keep, int threads) {
  PairCollector found = floats_do(ordered) ? find_pairs<float>(marks, ordered, keep, threads)
                                           : find_pairs<double>(marks, ordered, keep, threads);
  SelfIntersections result = std::move(found).sorted();
  result.zero_area_triangles = static_cast<std::int64_t>(triangle_count - ordered.size());
  return result;
}

}  // namespace

SelfIntersections self_intersections(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t keep,
                                     int threads) {
  return examined(OrderedTriangles(points, triangles, threads), triangles.size(), {}, keep, threads);
}

SelfIntersections self_intersections_of(std::span<const std::uint8_t> marks, TriangleMesh mesh, std::size_t keep,
                                        int threads) {
  const std::size_t triangle_count = mesh.triangles.size();
  const OrderedTriangles ordered(mesh.points, mesh.triangles, threads);
  mesh = {};
  return examined(ordered, triangle_count, marks, keep, threads);
}

}  // namespace deliso
